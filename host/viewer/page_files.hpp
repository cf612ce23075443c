// SPDX-License-Identifier: Apache-2.0
// The sources of the page, host/viewer/page/*, and three.min.js, as the build embedded them.
// They do not contain "</script", since each becomes a script element unchanged.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer {

// Throws RuntimeError for an unknown name.
std::string_view page_file(std::string_view name);

}  // namespace wavetracer
