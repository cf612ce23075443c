// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/beam_visible.cl.
#include "passes/beam_visible.hpp"

#include "passes/advice.hpp"

namespace wavetracer {
namespace {

constexpr size_t least_waiting = 1 << 12;
constexpr uint32_t rounds_together = 8;
constexpr uint32_t groups_per_unit = 16;  // a device has groups_per_unit groups for each unit; not measured

gpu::Definitions definitions_of(const Tuning& tuning) {
  return {{"WT_LANES", std::to_string(tuning.visible_lanes) + "u"},
          {"WT_TARGETS", std::to_string(tuning.visible_targets) + "u"}};
}

// round: 0 for beam_visible, whose count is that of chunks.
wt_beam_arguments arguments_of(const BeamLists& lists, uint32_t first_aperture, uint32_t count, uint32_t round,
                               const BeamStep& step, const Trie& set) {
  return {.first = first_aperture,
          .count = count,
          .capacity = static_cast<uint32_t>(lists.next.size()),
          .waiting_capacity = static_cast<uint32_t>(lists.waiting.size()),
          .trie_mask = static_cast<uint32_t>(set.table.size() - 1),
          .round = round,
          .last = step.depth == step.max_depth,
          .walls = step.walls,
          .edges = step.edges,
          .root = 0,
          .outlooks = 0};
}

}  // namespace

BeamVisible::BeamVisible(gpu::Context& context)
    : context_(context),
      lanes_(tuning_of(context.info()).visible_lanes),
      targets_(tuning_of(context.info()).visible_targets),
      groups_(context.info().compute_units * groups_per_unit),
      visible_(context, definitions_of(tuning_of(context.info()))),
      waiting_(context, definitions_of(tuning_of(context.info()))) {}

wt_beam_counters BeamVisible::run(const BeamTree& tree, const DeviceScene& scene, const BeamMirrors& mirrors,
                                  BeamLists& lists, uint32_t first_aperture, uint32_t chunks, const BeamStep& step,
                                  const Trie& set) {
  const auto arguments = [&](uint32_t count, uint32_t round) {
    return arguments_of(lists, first_aperture, count, round, step, set);
  };
  // Sets the numbers of pieces that wait to 0: both, or that of one round.
  const auto clear_waiting = [&](uint32_t first, uint32_t count) {
    const uint32_t none = 0;
    context_.fill(lists.counters, &none, sizeof none, offsetof(wt_beam_counters, waiting) + first * sizeof none,
                  count * sizeof none, Stage::beam_visible);
  };
  clear_waiting(0, 2);
  visible_({size_t{chunks} * (WT_CHUNK / targets_) * lanes_, lanes_}, Stage::beam_visible,
           calls::beam_visible::beam_visible{.facets = tree.facets,
                                             .corners = tree.corners,
                                             .surfaces = scene.exact_surfaces,
                                             .apertures = lists.apertures,
                                             .lit_spaces = lists.lit_spaces,
                                             .chunks = lists.chunks,
                                             .candidates = lists.candidates,
                                             .reflectances = mirrors.reflectances,
                                             .materials_of = mirrors.materials_of,
                                             .table = set.table,
                                             .quarters = set.quarters,
                                             .next = lists.next,
                                             .waiting = lists.waiting,
                                             .counters = lists.counters,
                                             .limit = mirrors.floor,
                                             .args = arguments(chunks, 0)});
  // The host asks after some rounds whether pieces still wait. Rounds without pieces take next to no time.
  for (uint32_t round = 1;; ++round) {
    if (round % rounds_together == 1) {
      const wt_beam_counters now = lists.counters.read_one(0, Stage::beam_visible);
      if (now.waiting[1 - round % 2] == 0 || now.most_waiting > 0 || now.trie_overflow != 0) return now;
    }
    std::swap(lists.pieces, lists.waiting);
    clear_waiting(round % 2, 1);
    waiting_({size_t{groups_} * lanes_, lanes_}, Stage::beam_visible,
             calls::beam_visible::beam_waiting{.facets = tree.facets,
                                               .corners = tree.corners,
                                               .surfaces = scene.exact_surfaces,
                                               .apertures = lists.apertures,
                                               .lit_spaces = lists.lit_spaces,
                                               .chunks = lists.chunks,
                                               .candidates = lists.candidates,
                                               .reflectances = mirrors.reflectances,
                                               .materials_of = mirrors.materials_of,
                                               .pieces = lists.pieces,
                                               .table = set.table,
                                               .quarters = set.quarters,
                                               .next = lists.next,
                                               .waiting = lists.waiting,
                                               .counters = lists.counters,
                                               .limit = mirrors.floor,
                                               .args = arguments(0, round)});
  }
}

void BeamVisible::operator()(const BeamTree& tree, const DeviceScene& scene, const BeamMirrors& mirrors,
                             BeamLists& lists, uint32_t first_aperture, uint32_t chunks, const BeamStep& step,
                             const Trie& set) {
  const auto reserve = [&](size_t pieces) {
    for (gpu::Buffer<wt_waiting_piece>* list : {&lists.pieces, &lists.waiting})
      *list = context_.buffer<wt_waiting_piece>(pieces, {"pieces", advice::beams});
  };
  if (lists.waiting.size() == 0) reserve(least_waiting);
  const wt_beam_counters before = lists.counters.read_one(0, Stage::beam_visible);
  for (;;) {
    const wt_beam_counters now = run(tree, scene, mirrors, lists, first_aperture, chunks, step, set);
    if (now.trie_overflow != 0 || (now.most_waiting == 0 && now.apertures <= lists.next.size())) return;
    if (now.most_waiting > 0) reserve(now.most_waiting + now.most_waiting / 4);
    if (now.apertures > lists.next.size()) {
      auto more = context_.buffer<wt_aperture>(now.apertures + now.apertures / 4, {"apertures", advice::beams});
      context_.copy(lists.next, more, before.apertures * sizeof(wt_aperture), Stage::beam_visible);
      lists.next = std::move(more);
    }
    lists.counters.write(std::vector{before}, 0, Stage::beam_visible);
  }
}

}  // namespace wavetracer
