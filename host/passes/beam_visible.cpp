// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/beam_visible.cl.
#include "passes/beam_visible.hpp"

namespace wavetracer {

BeamVisible::BeamVisible(gpu::Context& context) : work_(tuning_of(context.info()).exact), kernel_(context) {}

void BeamVisible::operator()(const BeamTree& tree, const DeviceScene& scene, BeamLists& lists, uint32_t chunks,
                             const BeamStep& step, const Trie& set) {
  kernel_(work_.range(chunks * WT_CHUNK), Stage::beam_visible,
          calls::beam_visible::beam_visible{
              .facets = tree.facets,
              .corners = tree.corners,
              .surfaces = scene.exact_surfaces,
              .apertures = lists.apertures,
              .chunks = lists.chunks,
              .candidates = lists.candidates,
              .table = set.table,
              .quarters = set.quarters,
              .next = lists.next,
              .counters = lists.counters,
              .args = wt_beam_arguments{.first = 0,
                                        .count = chunks,
                                        .capacity = static_cast<uint32_t>(lists.next.size()),
                                        .trie_mask = static_cast<uint32_t>(set.table.size() - 1),
                                        .last = step.last,
                                        .only_opaque = step.only_opaque}});
}

}  // namespace wavetracer
