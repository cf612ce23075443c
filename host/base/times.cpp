// SPDX-License-Identifier: Apache-2.0
// Spacings come from std::nextafter, digits from fmt.
#include "base/times.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include "base/digits.hpp"

namespace wavetracer {

double time_spacing_s(double time_s) {
  const double size_s = std::abs(time_s);
  return std::nextafter(size_s, std::numeric_limits<double>::infinity()) - size_s;
}

double time_tolerance_s(double time_s) { return std::max(1e-6, 2 * time_spacing_s(time_s)); }

std::string duration_text(double seconds) {
  if (seconds < 0.9995) return fmt::format("{:.3g} ms", seconds * 1e3);
  return seconds < 999.5 ? fmt::format("{:.3g} s", seconds)
                         : grouped(static_cast<uint64_t>(std::nearbyint(seconds))) + " s";
}

double simplest_decimal(double value, double error) {
  for (int digits = 0; digits < 16; ++digits) {
    const std::string text = fmt::format("{:.{}e}", value, digits);
    double out = value;
    std::from_chars(text.data(), text.data() + text.size(), out);
    if (std::abs(out - value) <= error) return out;
  }
  return value;
}

std::string time_text(double time_s) {
  const double size_s = std::abs(time_s);
  if (!(size_s < 1e15) || (size_s > 0 && size_s < 1e-3)) return fmt::format("{:g}", time_s);
  std::string out = fmt::format("{:.6f}", time_s);
  out.resize(out.find_last_not_of('0') + 1);
  if (out.ends_with('.')) out.pop_back();
  return out;
}

}  // namespace wavetracer
