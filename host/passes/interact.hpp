// SPDX-License-Identifier: Apache-2.0
// interact: rays that hit enter their prefix into the trie and go on, reflected and compacted in order; if a queue for
// transmitted rays is given, they also go straight through the surface. hits.block_hits must have been scanned.
#pragma once
#include "kernel_calls/interact.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/trie.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

// Additional outputs of interact; the code of each option is compiled only where it is on.
struct InteractOptions {
  bool ages = false;          // the trie keeps ages
  bool samples = false;       // rays carry the number of their sample, and note its end
  bool labels = false;        // queues have WT_RAY_LABELLED_PLANES, see label_rays
  bool transmission = false;  // rays may also go on straight
};

// The queues in which rays go on. All have the capacity of the queue that the rays come from; a null queue is left out.
struct RaysOnward {
  RayQueue* reflected = nullptr;                // its count becomes hit_count; null after the last interaction
  RayQueue* transmitted = nullptr;              // the same rays behind the surface, with the node that they came with
  const gpu::Buffer<uint32_t>* ends = nullptr;  // one for each sample, needed with InteractOptions::samples
};

class Interact {
 public:
  explicit Interact(gpu::Context& context, InteractOptions options = {});
  // hit_count: that of the rays in the queue. Sequences that rays reach get the bits of their quarters and, where ages
  // are kept, the age `now`. Throws std::logic_error where the trie or `to` lack what the options ask for.
  void operator()(const DeviceScene& scene, const RayQueue& rays, const HitList& hits, uint32_t hit_count,
                  const Trie& trie, const RaysOnward& to);

 private:
  InteractOptions options_;
  gpu::KernelOf<calls::interact::interact> kernel_;
  gpu::KernelOf<calls::interact::interact> kernel_through_;
  Work work_;
};

}  // namespace wavetracer
