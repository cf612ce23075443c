// SPDX-License-Identifier: Apache-2.0
#include "calibration/agreement.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include "study/statistics.hpp"

namespace wavetracer::calibration {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Gives blocks first to first + count - 1 to the points.
void divide(std::span<size_t> points, std::span<const double> x, std::span<const double> y, unsigned first,
            unsigned count, std::vector<unsigned>& block) {
  if (count == 1) {
    for (const size_t point : points) block[point] = first;
    return;
  }
  const auto extent = [&](std::span<const double> of) {
    double least = INFINITY, most = -INFINITY;
    for (const size_t point : points) {
      least = std::min(least, of[point]);
      most = std::max(most, of[point]);
    }
    return most - least;
  };
  const std::span<const double> along = extent(x) >= extent(y) ? x : y;
  std::ranges::stable_sort(points, {}, [&](size_t point) { return along[point]; });
  const unsigned half = count / 2;
  const size_t cut = points.size() * half / count;
  divide(points.first(cut), x, y, first, half, block);
  divide(points.subspan(cut), x, y, first + half, count - half, block);
}

}  // namespace

std::vector<double> ranks_of(std::span<const double> values) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) { return values[i]; });
  std::vector<double> out(values.size());
  for (size_t first = 0; first < order.size();) {
    size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (size_t i = first; i < end; ++i) out[order[i]] = 0.5 * static_cast<double>(first + 1 + end);
    first = end;
  }
  return out;
}

Statistics statistics_of(std::span<const LevelPair> pairs) {
  Statistics out{.points = pairs.size(),
                 .offset_db = study::undefined,
                 .sigma_db = study::undefined,
                 .spearman = study::undefined};
  std::vector<double> measured, computed, off;
  for (const LevelPair& pair : pairs)
    if (std::isfinite(pair.computed_db)) {
      measured.push_back(pair.measured_db);
      computed.push_back(pair.computed_db);
      off.push_back(pair.measured_db - pair.computed_db);
    }
  out.with_a_path = off.size();
  if (off.size() < 2) return out;
  out.offset_db = mean_of(off);
  double sum = 0;
  for (const double value : off) sum += (value - out.offset_db) * (value - out.offset_db);
  out.sigma_db = std::sqrt(sum / static_cast<double>(off.size() - 1));
  out.spearman = study::pearson(ranks_of(measured), ranks_of(computed));
  return out;
}

std::string held_out_warning(const Agreement& all) {
  constexpr double tolerated = 1.05;
  if (!(all.held_out.sigma_db > tolerated * all.before.sigma_db)) return "";
  return fmt::format(
      "places that were held out agree less well than as configured ({:.2f} dB against {:.2f} dB): the data do not "
      "support this fit; fit fewer parameters, give smaller uncertainties by --prior, or keep the configuration",
      all.held_out.sigma_db, all.before.sigma_db);
}

std::vector<unsigned> spatial_blocks(std::span<const double> x, std::span<const double> y, unsigned count) {
  std::vector<size_t> points(x.size());
  std::iota(points.begin(), points.end(), size_t{0});
  std::vector<unsigned> out(x.size());
  divide(points, x, y, 0, count, out);
  return out;
}

}  // namespace wavetracer::calibration
