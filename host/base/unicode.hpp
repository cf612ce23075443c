// SPDX-License-Identifier: Apache-2.0
// Converts text to the encodings of other programs.
// A byte that is not UTF-8 becomes U+FFFD, so nothing is dropped and nothing fails.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer {

// Removes one character from the front of a text that is not empty, and returns it.
char32_t take_utf8(std::string_view& text);
void append_utf8(std::string& text, char32_t code);

std::u32string utf32(std::string_view utf8);
std::u16string utf16(std::string_view utf8);

}  // namespace wavetracer
