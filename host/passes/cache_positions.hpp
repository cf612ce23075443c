// SPDX-License-Identifier: Apache-2.0
// The positions that entries of a ray cache belong to, one for each region: where a region's position key changes, its
// older entries are stale (A. Zhdanov, TU Munich, 2014, algorithm 3).
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "passes/cache_table.hpp"

namespace wavetracer {

class CachePositions {
 public:
  explicit CachePositions(size_t regions) : keys_(regions), known_(regions) {}
  // Notes the position of a region in this frame; returns whether its key has changed, or is its first one. Then the
  // record of the region says that entries from before this frame are stale; upload table.regions afterwards.
  bool note(CacheTable& table, uint32_t region, const glm::dvec3& position_m, uint32_t frame);

 private:
  std::vector<uint64_t> keys_;
  std::vector<bool> known_;
};

}  // namespace wavetracer
