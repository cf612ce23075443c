// What names of radio ends, vehicles and models may be: they stand in tables, plots and messages, a line each.
#pragma once
#include <algorithm>
#include <string_view>

namespace wavetracer {

// NUL, a line break, any other character of ASCII that controls instead of being shown.
inline bool has_control_character(std::string_view name) {
  return std::any_of(name.begin(), name.end(), [](char c) { return (c >= 0 && c < ' ') || c == 127; });
}

}  // namespace wavetracer
