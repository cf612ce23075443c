// SPDX-License-Identifier: Apache-2.0
// Parses with std::from_chars and the checks that a trajectory file needs.
// NaN and infinity do not count as numbers here.
#include "motion/input_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "wavetracer/error.hpp"

namespace wavetracer {

void fail_at(const std::string& file, uint64_t line, std::string_view what) {
  throw InputError(fmt::format("{}:{}: {}", file, line, what));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  return first == text.npos ? std::string_view{} : text.substr(first, last - first + 1);
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return out;
}

std::optional<double> finite_number(std::string_view text) {
  text = trimmed(text);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> seconds(std::string_view text) {
  text = trimmed(text);
  const std::ptrdiff_t colons = std::count(text.begin(), text.end(), ':');
  if (colons == 0) return finite_number(text);
  if (colons != 2 && colons != 3) return std::nullopt;
  constexpr double units_s[] = {86400, 3600, 60, 1};
  constexpr double bounds[] = {std::numeric_limits<double>::infinity(), 24, 60, 60};
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  const std::ptrdiff_t first = 3 - colons;
  double sum = 0;
  for (std::ptrdiff_t unit = first; unit < 4; ++unit) {
    const size_t end = std::min(text.find(':'), text.size());
    const std::optional<double> part = finite_number(text.substr(0, end));
    if (!part || std::signbit(*part) || (unit < 3 && *part != std::floor(*part))) return std::nullopt;
    if (unit > first && *part >= bounds[unit]) return std::nullopt;  // the first part has no upper bound
    sum += *part * units_s[unit];
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return negative ? -sum : sum;
}

}  // namespace wavetracer
