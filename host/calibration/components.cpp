// SPDX-License-Identifier: Apache-2.0
#include "calibration/components.hpp"
#include <cmath>
#include <numbers>

namespace wavetracer::calibration {

const MeasuredPoint* Components::add(const MeasuredPoint& point, const std::string& position,
                                     const Component& component) {
  constexpr double not_given = 1e9;  // no angle is as large
  const Key key{
      position,
      position.empty() ? point.position : std::array<double, 3>{},
      point.tx,
      point.rx,
      {point.yaw_deg.value_or(not_given), point.pitch_deg.value_or(not_given), point.roll_deg.value_or(not_given)}};
  const auto [at, added] = known_.try_emplace(key, gathered_.size());
  if (added) gathered_.push_back({point, Spreads(1e-9 * component.delay_ns), {}});
  Gathered& own = gathered_[at->second];
  if (own.first.position != point.position || own.first.group != point.group) return &own.first;
  const double power = std::pow(10, 0.1 * point.level_db), delay_s = 1e-9 * component.delay_ns;
  own.spreads.add(power, delay_s, component.azimuth_deg * std::numbers::pi / 180);
  own.components.push_back({delay_s, power});
  return nullptr;
}

std::vector<MeasuredPoint> Components::points(bool with_delays, bool with_azimuths) const {
  constexpr double least_ns = 1e-6, least_deg = 1e-4;  // smaller spreads are rounding
  std::vector<MeasuredPoint> out;
  for (const Gathered& own : gathered_) {
    MeasuredPoint& point = out.emplace_back(own.first);
    point.level_db = 10 * std::log10(own.spreads.power());
    const double delay_ns = own.spreads.delay_ns(), azimuth_deg = own.spreads.azimuth_deg();
    if (with_delays) point.components = own.components;
    if (with_delays && delay_ns > least_ns) point.delay_spread_ns = delay_ns;
    if (with_azimuths && azimuth_deg > least_deg && std::isfinite(azimuth_deg)) point.azimuth_spread_deg = azimuth_deg;
  }
  return out;
}

}  // namespace wavetracer::calibration
