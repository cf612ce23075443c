// SPDX-License-Identifier: Apache-2.0
// The tree of a frame over the boxes of its instances: halved by count along the longest axis, one instance per leaf.
// It is balanced, so no deeper than log2 of their number, and is built anew every frame on one core.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "accel/box.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer {

struct TopLevel {
  std::vector<wt_bvh2_node> nodes;  // node 0 is the root
  std::vector<uint32_t> order;      // leaf k holds box order[k]
};

// Boxes must not be empty; without boxes it returns a root that no ray enters.
TopLevel build_top_level(std::span<const Box> boxes);

}  // namespace wavetracer
