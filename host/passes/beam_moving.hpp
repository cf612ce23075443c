// SPDX-License-Identifier: Apache-2.0
// beam_moving: the apertures of a tree that is kept which may see instances where these are now.
#pragma once
#include <vector>

#include "kernel_calls/beam_moving.hpp"
#include "passes/beam_lists.hpp"
#include "passes/device_scene.hpp"

namespace wavetracer {

// The apertures of one depth of a tree that is kept.
struct KeptApertures {
  gpu::Buffer<wt_aperture> apertures;
  gpu::Buffer<wt_outlook> outlooks;  // one for each aperture
  uint32_t count = 0;
  uint64_t bytes() const { return apertures.bytes() + outlooks.bytes(); }
};

class BeamMoving {
 public:
  explicit BeamMoving(gpu::Context& context);
  // The boxes of the instances that are present.
  void place(const std::vector<wt_instance_box>& boxes);
  // Appends to the first `count` of lists.apertures those of a depth that may see instances past the static world, and
  // returns the length of the list. walls: as in BeamStep. The counter of apertures is 0 after it.
  uint32_t operator()(const DeviceScene& scene, const KeptApertures& kept, BeamLists& lists, uint32_t count,
                      uint32_t walls);

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::beam_moving::beam_moving> kernel_;
  gpu::Buffer<wt_instance_box> boxes_;
  uint32_t box_count_ = 0;
};

}  // namespace wavetracer
