// SPDX-License-Identifier: Apache-2.0
// Keys of positions on the host.
#include "passes/cache_positions.hpp"

#include <cmath>

namespace wavetracer {

namespace {

// The quantised position of a transmitter (section 4.2.3), 21 bits for each component, compared as a whole.
uint64_t position_key(const glm::dvec3& position_m, double step_m) {
  const auto cell = [step_m](double x) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(x / step_m))) & 0x1FFFFF;
  };
  return cell(position_m.x) | cell(position_m.y) << 21 | cell(position_m.z) << 42;
}

}  // namespace

bool CachePositions::note(CacheTable& table, uint32_t region, const glm::dvec3& position_m, uint32_t frame) {
  const uint64_t key = position_key(position_m, table.config.position_step_m);
  if (known_.at(region) && key == keys_[region]) return false;
  keys_[region] = key;
  known_[region] = true;
  table.regions[region].since = frame;
  table.regions[region].stamp = device::wt_cache_tag(key, 0);
  return true;
}

}  // namespace wavetracer
