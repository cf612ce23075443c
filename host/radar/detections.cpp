// SPDX-License-Identifier: Apache-2.0
// Sums over squares are sums of sums: first over shifts, then over delays.
#include "radar/detections.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "radio/constants.hpp"

namespace wavetracer {
namespace {

// A map as cells on two circles.
struct CellMap {
  const std::vector<double>& values;
  size_t shifts, delays;

  double at(size_t shift, int64_t by_shift, size_t delay, int64_t by_delay) const {
    return values[wrapped(shift, by_shift, shifts) * delays + wrapped(delay, by_delay, delays)];
  }
  static size_t wrapped(size_t i, int64_t by, size_t count) {
    const auto n = static_cast<int64_t>(count);
    return static_cast<size_t>(((static_cast<int64_t>(i) + by) % n + n) % n);
  }
};

// Adds a row of cells to another one.
void add_row(const double* cells, size_t count, double* sum) {
  for (size_t s = 0; s < count; ++s) sum[s] += cells[s];
}

// Sums over (2 r + 1) x (2 r + 1) cells about each.
std::vector<double> square_sums(const CellMap& map, int64_t r) {
  std::vector<double> out(map.values.size()), row(map.delays), around(map.delays + 2 * static_cast<size_t>(r));
  for (size_t n = 0; n < map.shifts; ++n) {
    std::ranges::fill(row, 0.0);
    for (int64_t by = r; by >= -r; --by)
      add_row(&map.values[CellMap::wrapped(n, by, map.shifts) * map.delays], map.delays, row.data());
    for (size_t i = 0; i < around.size(); ++i) around[i] = row[CellMap::wrapped(i, -r, map.delays)];
    for (int64_t by = r; by >= -r; --by)
      add_row(&around[static_cast<size_t>(r + by)], map.delays, &out[n * map.delays]);
  }
  return out;
}

bool is_largest(const CellMap& map, size_t shift, size_t delay) {
  const double here = map.at(shift, 0, delay, 0);
  for (int64_t a = -1; a <= 1; ++a)
    for (int64_t b = -1; b <= 1; ++b)
      if (map.at(shift, a, delay, b) > here) return false;
  return true;
}

// The place of the top of a parabola through a peak and both neighbours in dB, from -0.5 to 0.5 cells.
double off_centre(double before_w, double here_w, double after_w) {
  constexpr double least_w = 1e-300;
  const double before = std::log(std::max(before_w, least_w)), here = std::log(std::max(here_w, least_w)),
               after = std::log(std::max(after_w, least_w));
  const double bend = before - 2 * here + after;
  return bend < 0 ? 0.5 * (before - after) / bend : 0;
}

}  // namespace

std::vector<DetectedCell> detected_cells(const std::vector<double>& map_w, const RadarConfig& radar) {
  const CellMap map{map_w, radar.chirps, radar.samples};
  const std::vector<double> all = square_sums(map, radar.training), guarded = square_sums(map, radar.guard);
  const auto area = [](double r) { return (2 * r + 1) * (2 * r + 1); };
  const double cells = area(radar.training) - area(radar.guard);
  const double factor = cells * (std::pow(radar.false_alarm, -1 / cells) - 1);
  std::vector<DetectedCell> out;
  for (size_t n = 0; n < map.shifts; ++n)
    for (size_t s = 0; s < map.delays; ++s) {
      const size_t i = n * map.delays + s;
      const double threshold_w = std::max((all[i] - guarded[i]) / cells, 0.0) * factor;
      if (map_w[i] > threshold_w && is_largest(map, n, s)) out.push_back({n, s, map_w[i], threshold_w});
    }
  std::ranges::stable_sort(out, std::ranges::greater(), &DetectedCell::power_w);
  return out;
}

RadarDetections detections_of(const std::vector<DetectedCell>& cells, const std::vector<double>& map_w,
                              const RadarAxes& axes, double carrier_hz) {
  const CellMap map{map_w, axes.doppler_hz.size(), axes.delay_s.size()};
  const double delay_step = axes.delay_s[1] - axes.delay_s[0], shift_step = axes.doppler_hz[1] - axes.doppler_hz[0];
  const double half_c = speed_of_light_m_s / 2;
  RadarDetections out;
  for (const DetectedCell& cell : cells) {
    const size_t n = cell.shift, s = cell.delay;
    const double here = cell.power_w;
    const double by_delay = off_centre(map.at(n, 0, s, -1), here, map.at(n, 0, s, 1));
    const double by_shift = off_centre(map.at(n, -1, s, 0), here, map.at(n, 1, s, 0));
    out.delay_s.push_back(axes.delay_s[s] + by_delay * delay_step);
    out.range_m.push_back(out.delay_s.back() * half_c);
    out.doppler_hz.push_back(axes.doppler_hz[n] + by_shift * shift_step);
    out.speed_m_s.push_back(out.doppler_hz.back() * half_c / carrier_hz);
    out.power_dbm.push_back(dbm_of(here));
    out.threshold_dbm.push_back(dbm_of(std::max(cell.threshold_w, 1e-300)));
  }
  return out;
}

}  // namespace wavetracer
