// SPDX-License-Identifier: Apache-2.0
// Turns ranges into ray counts.
// Numbers are parsed by std::from_chars, so the locale does not matter.
#include "study/ray_counts.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

constexpr uint64_t fewest_rays = claimed_few, most_rays = 1000000000;  // 10^9

// Returns 0, which no range may contain, if the text is no whole number.
uint64_t whole_number(std::string_view text) {
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = problem == std::errc() && end == text.data() + text.size() && value == std::floor(value);
  return whole && value > 0 && value <= static_cast<double>(most_rays) * 10 ? static_cast<uint64_t>(value) : 0;
}

}  // namespace

RayRange parse_ray_range(const std::string& text) {
  const size_t colon = text.find(':');
  RayRange range{0, 0};
  if (colon != std::string::npos)
    range = {whole_number(std::string_view(text).substr(0, colon)),
             whole_number(std::string_view(text).substr(colon + 1))};
  if (range.first < fewest_rays || range.last > most_rays || range.first > range.last)
    throw ConfigError(
        fmt::format("--rays {}: not a range of ray counts; give A:B with {} <= A <= B <= {}, such as 1000:1e6", text,
                    grouped(fewest_rays), grouped(most_rays)));
  return range;
}

std::vector<uint64_t> ray_counts(RayRange range) {
  std::vector<uint64_t> counts;
  for (uint64_t decade = fewest_rays; decade <= most_rays; decade *= 10)
    for (const uint64_t count : {decade, 2 * decade, 5 * decade})
      if (count <= most_rays) counts.push_back(count);
  counts.insert(counts.end(), {claimed_many, thesis_most});
  std::ranges::sort(counts);
  std::erase_if(counts, [&](uint64_t count) { return count < range.first || count > range.last; });
  if (counts.empty())
    throw ConfigError(
        fmt::format("--rays {}:{}: no ray count of the figure lies in it; those are 1, 2 and 5 times a power of ten, "
                    "{} and {}",
                    range.first, range.last, grouped(claimed_many), grouped(thesis_most)));
  return counts;
}

}  // namespace wavetracer::study
