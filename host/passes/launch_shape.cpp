// SPDX-License-Identifier: Apache-2.0
// Ranges of launches.
// Work-groups are spread evenly over the dimensions: 2 x 2 x 2 for 8, 4 x 2 x 2 for 16.
#include "passes/launch_shape.hpp"

#include <algorithm>
#include <bit>
#include <string>

namespace wavetracer {

gpu::Range LaunchShape::range(size_t count, uint32_t preferred_local) const {
  const uint32_t group = local_size.value_or(preferred_local);
  if (dimensions == 1) return {count, group};
  const unsigned group_bits = static_cast<unsigned>(std::bit_width(group)) - 1;
  std::array<size_t, 3> local{1, 1, 1}, global{1, 1, 1};
  for (unsigned d = 0; d < dimensions; ++d) local[d] = size_t{1} << ((group_bits + dimensions - 1 - d) / dimensions);
  // Sides are powers of two. There are 16 or more curves where the count allows, so that the last one, which may be
  // nearly empty, wastes little; rows make one square or cube.
  const unsigned count_bits = static_cast<unsigned>(std::bit_width(count > 0 ? count - 1 : 0));
  const unsigned side_bits = curve ? (std::max(count_bits, 4u) - 4) / dimensions : count_bits / dimensions;
  const size_t side = std::max(size_t{1} << side_bits, local[0]);
  size_t layer = 1;
  for (unsigned d = 0; d + 1 < dimensions; ++d) layer *= global[d] = side;
  size_t& last = global[dimensions - 1];
  last = (count + layer - 1) / layer;
  if (curve) last = (last + side - 1) / side * side;
  return {global, local, dimensions};
}

void LaunchShape::define(gpu::Definitions& definitions) const {
  definitions["WT_LAUNCH_DIMENSIONS"] = std::to_string(dimensions);
  definitions["WT_LAUNCH_CURVE"] = std::to_string(static_cast<int>(curve));
}

}  // namespace wavetracer
