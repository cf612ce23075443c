// SPDX-License-Identifier: Apache-2.0
// beam_visible: the parts of facets that an image sees through an aperture. They enter their sequences into the trie
// and become the apertures of the next depth.
#pragma once
#include "kernel_calls/beam_visible.hpp"
#include "passes/beam_lists.hpp"
#include "passes/beam_tree.hpp"
#include "passes/device_scene.hpp"
#include "passes/trie.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

// The way that a depth is looked at.
struct BeamStep {
  bool last = false;         // no apertures are made
  bool only_opaque = false;  // waves pass surfaces that are not opaque
};

class BeamVisible {
 public:
  explicit BeamVisible(gpu::Context& context);
  // Looks at the candidates of the first `chunks` of lists.chunks, and appends to lists.next, which may be too short
  // for all (wt_beam_counters::apertures). All quarters have found the sequences.
  void operator()(const BeamTree& tree, const DeviceScene& scene, BeamLists& lists, uint32_t chunks,
                  const BeamStep& step, const Trie& set);

 private:
  Work work_;
  gpu::KernelOf<calls::beam_visible::beam_visible> kernel_;
};

}  // namespace wavetracer
