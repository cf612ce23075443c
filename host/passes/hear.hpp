// SPDX-License-Identifier: Apache-2.0
// hear: what rays from edges have met on their way to listeners, as sequences of the listeners.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/hear.hpp"
#include "passes/listener_map.hpp"
#include "passes/ray_queue.hpp"
#include "passes/trie.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class Hear {
 public:
  // roots: see EdgeRays. Listeners are roots from first_listener on. margin_m: the most that a ray passes above or
  // below the receivers of a listener that hears it.
  Hear(gpu::Context& context, uint32_t roots, uint32_t first_listener, double margin_m);
  // met: the trie that has the rays' sequences. Where `into` is too small for what is heard, its counters tell.
  void operator()(const RayQueue& rays, const HitList& hits, const gpu::Buffer<uint64_t>& met, const ListenerMap& map,
                  Trie into);

 private:
  gpu::KernelOf<calls::hear::hear> kernel_;
  Work work_;
  uint32_t roots_, first_listener_;
  float margin_m_;
};

}  // namespace wavetracer
