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

class BeamVisible {
 public:
  explicit BeamVisible(gpu::Context& context);
  // Looks at the candidates of the first `chunks` of lists.chunks, which beam_gather made for apertures from
  // first_aperture on, and appends to lists.next, unless all paths of a piece are below mirrors.floor. All quarters
  // have found the sequences. If the trie is too small, wt_beam_counters::trie_overflow is set, and all must begin
  // again.
  void operator()(const BeamTree& tree, const DeviceScene& scene, const BeamMirrors& mirrors, BeamLists& lists,
                  uint32_t first_aperture, uint32_t chunks, const BeamStep& step, const Trie& set);

 private:
  // Runs both kernels until no pieces wait or their list is too short. Returns the counters.
  wt_beam_counters run(const BeamTree& tree, const DeviceScene& scene, const BeamMirrors& mirrors, BeamLists& lists,
                       uint32_t first_aperture, uint32_t chunks, const BeamStep& step, const Trie& set);

  gpu::Context& context_;
  uint32_t lanes_, targets_, groups_;
  gpu::KernelOf<calls::beam_visible::beam_visible> visible_;
  gpu::KernelOf<calls::beam_visible::beam_waiting> waiting_;
};

}  // namespace wavetracer
