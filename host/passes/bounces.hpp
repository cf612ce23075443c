// SPDX-License-Identifier: Apache-2.0
// bounces: all segments of the rays of a queue in one launch, where nothing else happens to the queue between two
// depths. It enters the same sequences as trace, scan and interact, one depth after the other.
#pragma once
#include "kernel_calls/bounces.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/sequences.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class Bounces {
 public:
  // ages: whether the trie keeps them. samples: whether rays carry the number of their sample.
  Bounces(gpu::Context& context, const DeviceScene& scene, bool ages, bool samples);
  // interactions: the most of a ray. ends: one for each sample, where rays carry them, else null. Adds the rays to
  // wt_counters::ended. Throws std::logic_error where the trie or `ends` lack what it needs.
  void operator()(const DeviceScene& scene, const RayQueue& rays, uint32_t interactions, const Trie& trie,
                  const gpu::Buffer<uint32_t>* ends);

 private:
  bool ages_, samples_;
  gpu::KernelOf<calls::bounces::bounces> kernel_;
  Work work_;
};

}  // namespace wavetracer
