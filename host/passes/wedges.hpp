// SPDX-License-Identifier: Apache-2.0
// wedges: all wedges of the world on the device, those of instances at their places in a frame, and the surfaces that
// they bound. Static ones come first, then those of each instance as Instance::first_wedge says.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "kernel_calls/wedges.hpp"
#include "passes/device_scene.hpp"
#include "passes/wedge_lists.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

class Wedges {
 public:
  // free_edges: do half planes count? A wedge that does not count keeps its number, and bounds no surface.
  Wedges(gpu::Context& context, const Scene& scene, const std::vector<Scene>& models,
         const std::vector<Instance>& instances, bool free_edges);
  // Moves those of instances to their places in the frame; place must have run.
  void operator()(const DeviceScene& scene);

  uint32_t diffracting() const { return diffracting_; }  // wedges that count
  unsigned key_bits() const;                             // bits of wt_wedge_key
  const WedgeList& list() const { return list_; }

 private:
  gpu::KernelOf<calls::wedges::wedges> kernel_;
  uint32_t local_, static_count_ = 0, moving_count_ = 0, diffracting_ = 0;
  gpu::Buffer<wt_wedge> models_;
  WedgeList list_;
};

}  // namespace wavetracer
