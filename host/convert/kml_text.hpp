// SPDX-License-Identifier: Apache-2.0
// Text between the tags of an XML 1.0 file.
// Assumes that the file says encoding="UTF-8".
#pragma once
#include <string>
#include <string_view>

namespace wavetracer {

// Escapes <, >, &, " and '; bytes that are not UTF-8, and characters that XML forbids, become U+FFFD.
std::string xml_text(std::string_view utf8);

}  // namespace wavetracer
