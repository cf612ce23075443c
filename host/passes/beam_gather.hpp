// SPDX-License-Identifier: Apache-2.0
// beam_gather: the facets that images may see through their apertures, or that may hide others there.
#pragma once
#include "kernel_calls/beam_gather.hpp"
#include "passes/beam_lists.hpp"
#include "passes/beam_tree.hpp"
#include "passes/device_scene.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class BeamGather {
 public:
  // depth: the number of nodes from the root of the tree to a leaf, at most.
  BeamGather(gpu::Context& context, uint32_t depth);
  // Fills lists.chunks from its beginning for apertures first to first + count - 1, and returns their number. The list
  // grows when it must; if the number is more than `most`, it does not hold them.
  uint32_t operator()(const BeamTree& tree, const DeviceScene& scene, BeamLists& lists, uint32_t first, uint32_t count,
                      const BeamStep& step, uint32_t most);

 private:
  gpu::Context& context_;
  uint32_t lanes_;
  gpu::KernelOf<calls::beam_gather::beam_gather> kernel_;
};

}  // namespace wavetracer
