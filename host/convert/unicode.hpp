// SPDX-License-Identifier: Apache-2.0
// Converts names of runs to the encodings of other programs, and to text of XML. A byte that is not UTF-8 becomes
// U+FFFD, so nothing is dropped and nothing fails.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer {

std::u32string utf32(std::string_view utf8);
std::u16string utf16(std::string_view utf8);

// Escapes <, >, &, " and '; bytes that are not UTF-8, and characters that XML forbids, become U+FFFD.
std::string xml_text(std::string_view utf8);

}  // namespace wavetracer
