// SPDX-License-Identifier: Apache-2.0
// The names that radio ends, vehicles and models may have: tables, plots and messages show them on one line.
#pragma once
#include <algorithm>
#include <string_view>

namespace wavetracer {

// True if the text contains an ASCII control character, such as NUL or a line break.
inline bool has_control_character(std::string_view name) {
  return std::any_of(name.begin(), name.end(), [](char c) { return (c >= 0 && c < ' ') || c == 127; });
}

}  // namespace wavetracer
