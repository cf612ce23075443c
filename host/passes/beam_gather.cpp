// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/beam_gather.cl.
#include "passes/beam_gather.hpp"

#include <bit>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"

namespace wavetracer {

BeamGather::BeamGather(gpu::Context& context, uint32_t depth)
    : context_(context),
      lanes_(tuning_of(context.info()).gather_lanes),
      kernel_(context, {{"WT_BEAM_DEPTH", std::to_string(depth) + "u"}, {"WT_LANES", std::to_string(lanes_) + "u"}}) {}

uint32_t BeamGather::operator()(const BeamTree& tree, const DeviceScene& scene, BeamLists& lists, uint32_t first,
                                uint32_t count, const BeamStep& step, uint32_t most) {
  constexpr uint32_t least = 1 << 11;
  const auto reserve = [&](size_t chunks) {
    lists.chunks = context_.buffer<wt_chunk>(chunks, {"beam candidates", advice::beams});
    lists.candidates = context_.buffer<wt_beam_candidate>(chunks * WT_CHUNK, {"beam candidates", advice::beams});
  };
  if (lists.chunks.size() == 0) reserve(least);
  if (lists.lit_spaces.size() < count)
    lists.lit_spaces = context_.buffer<wt_lit_space>(std::bit_ceil(count), {"beams", advice::beams});
  const auto restart = [&] {
    const uint32_t none = 0;
    context_.fill(lists.counters, &none, sizeof none, offsetof(wt_beam_counters, chunks), sizeof none,
                  Stage::beam_gather);
  };
  restart();
  return grow_until_filled(
      [&] {
        kernel_({size_t{count} * lanes_, lanes_}, Stage::beam_gather,
                calls::beam_gather::beam_gather{
                    .nodes = tree.nodes,
                    .facets = tree.facets,
                    .corners = tree.corners,
                    .surfaces = scene.exact_surfaces,
                    .apertures = lists.apertures,
                    .lit_spaces = lists.lit_spaces,
                    .outlooks = step.outlooks ? *step.outlooks : lists.no_outlooks,
                    .chunks = lists.chunks,
                    .candidates = lists.candidates,
                    .counters = lists.counters,
                    .args = wt_beam_arguments{.first = first,
                                              .count = count,
                                              .capacity = static_cast<uint32_t>(lists.chunks.size()),
                                              .waiting_capacity = 0,
                                              .trie_mask = 0,
                                              .round = 0,
                                              .last = 0,
                                              .walls = step.walls,
                                              .edges = step.edges,
                                              .root = step.root,
                                              .outlooks = step.outlooks != nullptr}});
      },
      [&] { return lists.counters.read_one(0, Stage::beam_gather).chunks; }, [&] { return lists.chunks.size(); },
      [&](size_t chunks) {
        reserve(chunks);
        restart();
      },
      most);
}

}  // namespace wavetracer
