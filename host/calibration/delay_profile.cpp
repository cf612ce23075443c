// SPDX-License-Identifier: Apache-2.0
#include "calibration/delay_profile.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace wavetracer::calibration {
namespace {

double sum_of(std::span<const DelayPower> components) {
  double out = 0;
  for (const DelayPower& component : components) out += component.power;
  return out;
}

// Delay of the first component that has at least the range of the whole power; of any, if none has.
double first_delay(std::span<const DelayPower> components) {
  const double least = sum_of(components) * std::pow(10, -0.1 * profile_range_db);
  double out = std::numeric_limits<double>::infinity(), any = out;
  for (const DelayPower& component : components) {
    any = std::min(any, component.delay_s);
    if (component.power >= least) out = std::min(out, component.delay_s);
  }
  return std::isfinite(out) ? out : any;
}

}  // namespace

std::vector<double> delay_profile(std::span<const DelayPower> components, double bin_s, size_t bins) {
  std::vector<double> powers(bins, 0.0);
  const double first_s = first_delay(components);
  for (const DelayPower& component : components) {
    const double place = std::max(0.0, (component.delay_s - first_s) / bin_s);
    if (!(place < static_cast<double>(bins))) continue;
    const auto bin = static_cast<size_t>(place);
    const double share = place - static_cast<double>(bin);
    powers[bin] += (1 - share) * component.power;
    if (bin + 1 < bins) powers[bin + 1] += share * component.power;
  }
  double whole = 0;
  for (const double power : powers) whole += power;
  if (!(whole > 0)) return {};
  for (double& power : powers) power = std::max(10 * std::log10(power / whole), least_bin_db);
  return powers;
}

size_t bins_of(std::span<const DelayPower> components, double bin_s, size_t most) {
  const double first_s = first_delay(components);
  double last_s = first_s;
  for (const DelayPower& component : components) last_s = std::max(last_s, component.delay_s);
  const double bins = std::floor((last_s - first_s) / bin_s) + 2;
  return bins < static_cast<double>(most) ? static_cast<size_t>(bins) : most;
}

}  // namespace wavetracer::calibration
