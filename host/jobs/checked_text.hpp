// SPDX-License-Identifier: Apache-2.0
// JSON objects with a hash of their own text as the last key, "check", so that damage can be detected.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer {

// Returns the object with the key added. object: the text of a JSON object that is not empty, which ends in its brace.
std::string with_check(std::string object);
// Tells whether text made by with_check() is unchanged. Blanks and line ends after it do not count.
bool check_fits(std::string_view text);

}  // namespace wavetracer
