// SPDX-License-Identifier: Apache-2.0
// Numbers for people: digits grouped by commas, large ones with a prefix.
#pragma once
#include <fmt/format.h>
#include <cstdint>
#include <string>
#include <utility>

namespace wavetracer {

// Example: 1234567 gives 1,234,567.
inline std::string grouped(uint64_t number) {
  std::string out = std::to_string(number);
  for (size_t end = out.size(); end > 3; end -= 3) out.insert(end - 3, ",");
  return out;
}

// Returns the number with an SI prefix, ready for a unit: "12.3 G", "45.6 M", "789 k", "12 ".
inline std::string short_number(double x) {
  for (const auto& [limit, letter] : {std::pair{1e9, "G"}, {1e6, "M"}, {1e3, "k"}})
    if (x >= limit) return fmt::format("{:.3g} {}", x / limit, letter);
  return fmt::format("{:.3g} ", x);
}

}  // namespace wavetracer
