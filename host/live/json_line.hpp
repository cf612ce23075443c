// SPDX-License-Identifier: Apache-2.0
// A line of JSON that is written piece by piece. Doubles have enough digits to read back to the same bits; values that
// are not finite are null.
#pragma once
#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace wavetracer::live {

// Writes any text as a JSON string; bytes that are not UTF-8 become U+FFFD.
inline std::string text_of(std::string_view text) {
  return nlohmann::ordered_json(text).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

class Line {
 public:
  void raw(std::string_view text) { out_.append(text); }
  void number(double value) {
    if (std::isfinite(value))
      fmt::format_to(std::back_inserter(out_), FMT_COMPILE("{}"), value);
    else
      raw("null");
  }
  void integer(uint64_t value) { fmt::format_to(std::back_inserter(out_), FMT_COMPILE("{}"), value); }
  void text(std::string_view value) { raw(text_of(value)); }
  // Writes "key": with the comma before it.
  void key(std::string_view name) {
    raw(",\"");
    raw(name);
    raw("\":");
  }
  // Writes [item(0), item(1), ...].
  template <class Item>
  void list(size_t first, size_t end, const Item& item) {
    raw("[");
    for (size_t i = first; i < end; ++i) {
      if (i > first) raw(",");
      item(i);
    }
    raw("]");
  }
  std::string take() && {
    raw("\n");
    return fmt::to_string(out_);
  }

 private:
  fmt::memory_buffer out_;
};

}  // namespace wavetracer::live
