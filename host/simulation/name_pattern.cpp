// SPDX-License-Identifier: Apache-2.0
// Matching goes back to one place only: the last * has to be tried again, since it can take the characters of earlier
// ones. There are few patterns; the nearest name is only looked for when a mistake is reported.
#include "simulation/name_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/spelling.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

bool matches(std::string_view pattern, std::string_view name) {
  size_t p = 0, n = 0, star = pattern.npos, star_end = 0;  // the last * took the name up to star_end
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_end = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != pattern.npos) {
      p = star + 1;
      n = ++star_end;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == pattern.npos;
}

void require_match(std::string_view pattern, const std::vector<std::string>& names, std::string_view key,
                   std::string_view what) {
  if (pattern == "*") return;
  if (std::any_of(names.begin(), names.end(), [&](const std::string& name) { return matches(pattern, name); })) return;
  std::string plain(pattern);
  std::erase_if(plain, [](char c) { return c == '*' || c == '?'; });
  const auto nearest = std::min_element(names.begin(), names.end(), [&](const std::string& a, const std::string& b) {
    return edit_distance(plain, a) < edit_distance(plain, b);
  });
  throw ConfigError(fmt::format("{}: \"{}\" is not the name of a {}; {}", key, pattern, what,
                                nearest == names.end() ? "there is none" : "the nearest is \"" + *nearest + "\""));
}

}  // namespace wavetracer
