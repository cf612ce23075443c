// SPDX-License-Identifier: Apache-2.0
// A run may have 2^32 frames, so units are never listed: their bounds are computed.
// first <= last and shard_frames > 0.
#include "jobs/units.hpp"
#include <fmt/format.h>
#include <algorithm>

namespace wavetracer {

std::string unit_name(const Unit& unit) {
  const std::string frames = fmt::format("frames_{:06}_{:06}", unit.first, unit.last);
  return unit.blocks == 1 ? frames : fmt::format("{}_block_{:02}_of_{:02}", frames, unit.block, unit.blocks);
}

std::string unit_words(const Unit& unit) {
  if (unit.blocks > 1) return fmt::format("block {} of {}", unit.block + 1, unit.blocks);
  return unit.first == unit.last ? fmt::format("frame {}", unit.first)
                                 : fmt::format("frames {} to {}", unit.first, unit.last);
}

Units::Units(uint32_t first, uint32_t last, uint32_t shard_frames, uint32_t blocks)
    : first_(first), last_(last), shard_frames_(shard_frames), blocks_(blocks) {
  count_ = blocks > 1 ? blocks : uint64_t{last / shard_frames} - first / shard_frames + 1;
}

Unit Units::at(uint64_t index) const {
  if (blocks_ > 1) return {first_, last_, static_cast<uint32_t>(index), blocks_};
  const uint64_t begin = (first_ / shard_frames_ + index) * shard_frames_;
  return {static_cast<uint32_t>(std::max<uint64_t>(begin, first_)),
          static_cast<uint32_t>(std::min<uint64_t>(begin + shard_frames_ - 1, last_)), 0, 1};
}

UnitCounts for_each_unit(const Units& units, const UnitOrder& order, const UnitLoop& loop) {
  UnitCounts counts;
  for (uint64_t i = 0; i < order.count; ++i) {
    const Unit unit = units.at((order.first + i * order.step) % units.count());
    if (loop.finished(unit)) continue;
    const UnitChoice choice = loop.choose(unit);
    if (choice == UnitChoice::stop) break;
    if (choice == UnitChoice::elsewhere)
      ++counts.elsewhere;
    else if (choice == UnitChoice::compute && loop.compute(unit))
      ++counts.computed;
    else
      ++counts.left;
  }
  return counts;
}

}  // namespace wavetracer
