// SPDX-License-Identifier: Apache-2.0
// The lists that the passes of diffracted paths hand on: the wedges of the world, and the prefixes that see them.
// Layouts are wt_wedge and wt_wedge_prefix in wavetracer/device/records.h.
#pragma once
#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

struct WedgeList {
  gpu::Buffer<wt_wedge> wedges;
  // The wedges of surface s are of_surfaces[first[s] .. first[s + 1]]. A corner is seen from one side of it: those on
  // the side against its normal come before sides[2 s], those on the other from sides[2 s + 1] on.
  gpu::Buffer<uint32_t> first, sides, of_surfaces;
};

// Prefixes with their wedges as keys. Once the keys are sorted, order[i] is the place that the prefix of key i had, and
// sorted[i] is that prefix: prefixes that see one wedge are together.
struct WedgePrefixList {
  gpu::Buffer<uint32_t> keys, order;
  gpu::Buffer<wt_wedge_prefix> prefixes, sorted;
  uint32_t count = 0;
};

}  // namespace wavetracer
