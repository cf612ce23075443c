// SPDX-License-Identifier: Apache-2.0
// wedge_prefixes: the wedges that the prefixes of all ends see, and the places from which their images look at them.
// The list grows until it holds them.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/wedge_prefixes.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/tuning.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

class WedgePrefixes {
 public:
  explicit WedgePrefixes(gpu::Context& context);
  // nodes: those of the trie, in any order; roots among them are skipped. The keys are not sorted yet.
  WedgePrefixList& operator()(const DeviceScene& scene, const WedgeList& wedges, const RadioEnds& ends,
                              const gpu::Buffer<uint64_t>& trie, const gpu::Buffer<uint32_t>& quarters,
                              const gpu::Buffer<uint32_t>& nodes, uint32_t node_count, Counters& counters);
  // The list as it is now.
  const WedgePrefixList& list() const { return list_; }
  // Sets list.sorted; the keys must be sorted.
  void place(WedgePrefixList& list);

 private:
  void reserve(size_t entries);

  gpu::Context& context_;
  Work work_;
  gpu::KernelOf<calls::wedge_prefixes::wedge_prefixes> kernel_;
  gpu::KernelOf<calls::wedge_prefixes::place_prefixes> place_;
  WedgePrefixList list_;
};

}  // namespace wavetracer
