// SPDX-License-Identifier: Apache-2.0
// Characters of XML 1.0, section 2.2, are written unchanged, except for those below.
#include "base/xml_text.hpp"
#include "base/unicode.hpp"

namespace wavetracer {
namespace {

constexpr char32_t replacement_of_xml = 0xFFFD;

bool is_xml(char32_t c) { return c >= 0x20 ? c != 0xFFFE && c != 0xFFFF : c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

std::string xml_text(std::string_view utf8) {
  std::string out;
  while (!utf8.empty()) {
    switch (const char32_t c = take_utf8(utf8)) {
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
      default:
        append_utf8(out, is_xml(c) ? c : replacement_of_xml);
    }
  }
  return out;
}

}  // namespace wavetracer
