// SPDX-License-Identifier: Apache-2.0
// Text between the tags of a file of XML 1.0 or HTML, or within double quotes of an attribute.
// Assumes that the file is UTF-8 and says so.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer {

// Escapes <, >, & and "; bytes that are not UTF-8, and characters that XML forbids, become U+FFFD.
std::string xml_text(std::string_view utf8);

}  // namespace wavetracer
