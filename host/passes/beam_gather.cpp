// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/beam_gather.cl.
#include "passes/beam_gather.hpp"

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"

namespace wavetracer {

BeamGather::BeamGather(gpu::Context& context, uint32_t stack)
    : context_(context),
      work_(tuning_of(context.info()).exact),
      kernel_(context, {{"WT_BEAM_STACK", std::to_string(stack)}}) {}

uint32_t BeamGather::operator()(const BeamTree& tree, const DeviceScene& scene, BeamLists& lists, uint32_t first,
                                uint32_t count, bool only_opaque, uint32_t most) {
  constexpr uint32_t least = 1 << 11;
  const auto reserve = [&](size_t chunks) {
    lists.chunks = context_.buffer<wt_chunk>(chunks, {"beam candidates", advice::links});
    lists.candidates = context_.buffer<wt_beam_candidate>(chunks * WT_CHUNK, {"beam candidates", advice::links});
  };
  if (lists.chunks.size() == 0) reserve(least);
  const auto restart = [&] {
    const uint32_t none = 0;
    context_.fill(lists.counters, &none, sizeof none, offsetof(wt_beam_counters, chunks), sizeof none,
                  Stage::beam_gather);
  };
  restart();
  return grow_until_filled(
      [&] {
        kernel_(work_.range(count), Stage::beam_gather,
                calls::beam_gather::beam_gather{
                    .nodes = tree.nodes,
                    .facets = tree.facets,
                    .corners = tree.corners,
                    .surfaces = scene.exact_surfaces,
                    .apertures = lists.apertures,
                    .chunks = lists.chunks,
                    .candidates = lists.candidates,
                    .counters = lists.counters,
                    .args = wt_beam_arguments{.first = first,
                                              .count = count,
                                              .capacity = static_cast<uint32_t>(lists.chunks.size()),
                                              .trie_mask = 0,
                                              .last = 0,
                                              .only_opaque = only_opaque}});
      },
      [&] { return lists.counters.read_one(0, Stage::beam_gather).chunks; }, [&] { return lists.chunks.size(); },
      [&](size_t chunks) {
        reserve(chunks);
        restart();
      },
      most);
}

}  // namespace wavetracer
