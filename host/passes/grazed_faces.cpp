// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/grazed_faces.cl.
#include "passes/grazed_faces.hpp"

namespace wavetracer {
namespace {

gpu::Definitions definitions_for(bool ages) {
  if (ages) return {{"WT_AGES", "1"}};
  return {};
}

}  // namespace

GrazedFaces::GrazedFaces(gpu::Context& context, bool ages)
    : context_(context), work_(tuning_of(context.info()).prefixes), kernel_(context, definitions_for(ages)) {}

void GrazedFaces::operator()(const DeviceScene& scene, const WedgeList& wedges, const RadioEnds& ends,
                             const Sequences::Found& found) {
  const uint32_t lanes = lanes_of_ends(context_.info(), ends.most_ends);
  const Trie& trie = found.trie;
  kernel_(work_.range(size_t{found.node_count} * lanes), Stage::grazed_faces,
          calls::grazed_faces::grazed_faces{.table = trie.table,
                                            .nodes = found.nodes,
                                            .ends = ends.transmitters,
                                            .first_ends = ends.first_ends,
                                            .surfaces = scene.exact_surfaces,
                                            .boxes = scene.surfaces,
                                            .first_wedges = wedges.first,
                                            .sides = wedges.sides,
                                            .surface_wedges = wedges.of_surfaces,
                                            .wedges = wedges.wedges,
                                            .quarters = trie.quarters,
                                            .counters = trie.counters.buffer(),
                                            .ages = trie.ages,
                                            .mask = static_cast<uint32_t>(trie.table.size() - 1),
                                            .node_count = found.node_count,
                                            .capacity = static_cast<uint32_t>(found.nodes.size()),
                                            .now = trie.now,
                                            .lanes = lanes});
}

}  // namespace wavetracer
