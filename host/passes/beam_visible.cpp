// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/beam_visible.cl.
#include "passes/beam_visible.hpp"

#include "passes/advice.hpp"

namespace wavetracer {
namespace {

constexpr size_t least_waiting = 1 << 12;

gpu::Definitions definitions_of(const Tuning& tuning) {
  return {{"WT_LANES", std::to_string(tuning.visible_lanes) + "u"},
          {"WT_TARGETS", std::to_string(tuning.visible_targets) + "u"}};
}

}  // namespace

BeamVisible::BeamVisible(gpu::Context& context)
    : context_(context),
      lanes_(tuning_of(context.info()).visible_lanes),
      targets_(tuning_of(context.info()).visible_targets),
      visible_(context, definitions_of(tuning_of(context.info()))),
      waiting_(context, definitions_of(tuning_of(context.info()))) {}

wt_beam_counters BeamVisible::run(const BeamTree& tree, const DeviceScene& scene, BeamLists& lists,
                                  uint32_t first_aperture, uint32_t chunks, const BeamStep& step, const Trie& set) {
  const auto arguments = [&](uint32_t count) {
    return wt_beam_arguments{.first = first_aperture,
                             .count = count,
                             .capacity = static_cast<uint32_t>(lists.next.size()),
                             .waiting_capacity = static_cast<uint32_t>(lists.waiting.size()),
                             .trie_mask = static_cast<uint32_t>(set.table.size() - 1),
                             .last = step.depth == step.max_depth,
                             .walls = step.walls};
  };
  visible_({size_t{chunks} * (WT_CHUNK / targets_) * lanes_, lanes_}, Stage::beam_visible,
           calls::beam_visible::beam_visible{.facets = tree.facets,
                                             .corners = tree.corners,
                                             .surfaces = scene.exact_surfaces,
                                             .apertures = lists.apertures,
                                             .lit_spaces = lists.lit_spaces,
                                             .chunks = lists.chunks,
                                             .candidates = lists.candidates,
                                             .table = set.table,
                                             .quarters = set.quarters,
                                             .next = lists.next,
                                             .waiting = lists.waiting,
                                             .counters = lists.counters,
                                             .args = arguments(chunks)});
  for (;;) {
    wt_beam_counters now = lists.counters.read_one(0, Stage::beam_visible);
    const uint32_t count = now.waiting;
    if (count == 0 || count > lists.waiting.size() || now.trie_overflow != 0) return now;
    std::swap(lists.pieces, lists.waiting);
    if (lists.waiting.size() < lists.pieces.size())
      lists.waiting = context_.buffer<wt_waiting_piece>(lists.pieces.size(), {"pieces", advice::links});
    now.waiting = 0;
    lists.counters.write(std::vector{now}, 0, Stage::beam_visible);
    waiting_({size_t{count} * lanes_, lanes_}, Stage::beam_visible,
             calls::beam_visible::beam_waiting{.facets = tree.facets,
                                               .corners = tree.corners,
                                               .surfaces = scene.exact_surfaces,
                                               .apertures = lists.apertures,
                                               .lit_spaces = lists.lit_spaces,
                                               .chunks = lists.chunks,
                                               .candidates = lists.candidates,
                                               .pieces = lists.pieces,
                                               .table = set.table,
                                               .quarters = set.quarters,
                                               .next = lists.next,
                                               .waiting = lists.waiting,
                                               .counters = lists.counters,
                                               .args = arguments(count)});
  }
}

void BeamVisible::operator()(const BeamTree& tree, const DeviceScene& scene, BeamLists& lists, uint32_t first_aperture,
                             uint32_t chunks, const BeamStep& step, const Trie& set) {
  if (lists.waiting.size() == 0)
    lists.waiting = context_.buffer<wt_waiting_piece>(least_waiting, {"pieces", advice::links});
  const wt_beam_counters before = lists.counters.read_one(0, Stage::beam_visible);
  for (;;) {
    const wt_beam_counters now = run(tree, scene, lists, first_aperture, chunks, step, set);
    if (now.trie_overflow != 0) return;
    if (now.waiting == 0 && now.apertures <= lists.next.size()) return;
    if (now.waiting > 0)
      lists.waiting = context_.buffer<wt_waiting_piece>(now.waiting + now.waiting / 4, {"pieces", advice::links});
    if (now.apertures > lists.next.size()) {
      auto more = context_.buffer<wt_aperture>(now.apertures + now.apertures / 4, {"apertures", advice::links});
      context_.copy(lists.next, more, before.apertures * sizeof(wt_aperture), Stage::beam_visible);
      lists.next = std::move(more);
    }
    lists.counters.write(std::vector{before}, 0, Stage::beam_visible);
  }
}

}  // namespace wavetracer
