// SPDX-License-Identifier: Apache-2.0
// Characters of XML 1.0, section 2.2, are written unchanged, except for those below.
#include "convert/kml_text.hpp"
#include "convert/unicode.hpp"

namespace wavetracer {
namespace {

constexpr char32_t replacement_of_xml = 0xFFFD;

bool is_xml(char32_t c) { return c >= 0x20 ? c != 0xFFFE && c != 0xFFFF : c == '\t' || c == '\n' || c == '\r'; }

void append_utf8(std::string& out, char32_t c) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | (c >> shift & 0x3F)); };
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0 | c >> 6);
    tail(0);
  } else if (c < 0x10000) {
    out += static_cast<char>(0xE0 | c >> 12);
    tail(6), tail(0);
  } else {
    out += static_cast<char>(0xF0 | c >> 18);
    tail(12), tail(6), tail(0);
  }
}

}  // namespace

std::string xml_text(std::string_view utf8) {
  std::string out;
  for (const char32_t c : utf32(utf8)) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&apos;";
        break;
      default:
        append_utf8(out, is_xml(c) ? c : replacement_of_xml);
    }
  }
  return out;
}

}  // namespace wavetracer
