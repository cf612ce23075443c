// SPDX-License-Identifier: Apache-2.0
// The lists that the passes of paths over points hand on: prefixes of ends that see tiles, see point_prefixes.cl.
#pragma once
#include <bit>
#include <cstdint>

#include "gpu/gpu.hpp"
#include "passes/solved_list.hpp"
#include "wavetracer/device/points.h"

namespace wavetracer {

// Once the keys are sorted, order[i] is the row that key i had, and sorted[i] says what the join needs of that row:
// prefixes that see one side of one tile are together.
struct PointPrefixList {
  SolvedList rows;  // open ones
  gpu::Buffer<uint32_t> keys, order;
  gpu::Buffer<wt_point_prefix> sorted;
  uint32_t hidden = 0;  // the key of rows whose legs are obstructed, larger than all others

  unsigned key_bits() const { return static_cast<unsigned>(std::bit_width(hidden)); }
};

}  // namespace wavetracer
