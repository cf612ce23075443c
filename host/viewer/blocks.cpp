// SPDX-License-Identifier: Apache-2.0
// Base64 by RFC 4648, and the elements around it.
// In JSON every < is replaced by an escape, which keeps the meaning, because < appears within strings only.
#include "viewer/blocks.hpp"

namespace wavetracer {

std::string base64(std::string_view bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) out += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string block_element(const std::string& name, const Packer& data) {
  return "<script type=\"text/plain\" id=\"block_" + name + "\">" + base64(data.bytes()) + "</script>\n";
}

std::string script_text(std::string json) {
  for (size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += 6) json.replace(at, 1, "\\u003c");
  return json;
}

}  // namespace wavetracer
