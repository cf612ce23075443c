// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/heard_join.cl.
// One work-item or several take a node of the trie, and share the receivers of its listener.
#include "passes/heard_join.hpp"

#include <algorithm>

#include "wavetracer/device/arguments.h"

namespace wavetracer {
namespace {

constexpr uint32_t most_lanes_of_node = 16;  // on GPUs

}  // namespace

HeardJoin::HeardJoin(gpu::Context& context, uint32_t max_depth, uint32_t pieces, double wavelength_m)
    : context_(context),
      kernel_(context),
      work_(tuning_of(context.info()).prefixes),
      max_depth_(max_depth),
      pieces_(pieces),
      end_detour_m_(static_cast<float>(WT_END_DETOUR * wavelength_m)) {}

uint32_t HeardJoin::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t in_sight,
                               const HeardNodes& heard, const WedgeList& wedges, const RadioEnds& ends,
                               WedgeCandidates& into, Counters& counters) {
  const uint32_t lanes = context_.info().cpu ? 1 : std::min(ends.most_ends, most_lanes_of_node);
  return into.fill(counters, Stage::heard_join, [&] {
    const wt_wedge_join_arguments arguments{.count = in_sight,
                                            .first = heard.first,
                                            .end = heard.end,
                                            .lanes = lanes,
                                            .transmitter_count = ends.transmitter_count,
                                            .groups = ends.receiver_capacity / 16,
                                            .max_depth = max_depth_,
                                            .capacity = into.capacity(),
                                            .end_detour_m = end_detour_m_,
                                            .pieces = pieces_,
                                            .floor = 0};
    kernel_(work_.range(size_t{heard.end - heard.first} * lanes), Stage::heard_join,
            calls::heard_join::heard_join{.table = heard.trie,
                                          .quarters = heard.quarters,
                                          .nodes = heard.nodes,
                                          .ends = ends.transmitters,
                                          .first_ends = ends.first_ends,
                                          .exact = scene.exact_surfaces,
                                          .surfaces = scene.surfaces,
                                          .wedges = wedges.wedges,
                                          .keys = prefixes.keys,
                                          .prefixes = prefixes.sorted,
                                          .receiver_of_end = ends.receiver_of_end,
                                          .links = ends.links,
                                          .out = into.list(),
                                          .counters = counters.buffer(),
                                          .args = arguments});
  });
}

}  // namespace wavetracer
