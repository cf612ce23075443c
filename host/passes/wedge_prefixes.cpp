// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/wedge_prefixes.cl.
// One work-item or several take a node of the trie; then each takes one prefix.
#include "passes/wedge_prefixes.hpp"

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {
WedgePrefixes::WedgePrefixes(gpu::Context& context)
    : context_(context), work_(tuning_of(context.info()).prefixes), kernel_(context), place_(context) {
  reserve(1 << 14);
}

void WedgePrefixes::reserve(size_t entries) {
  list_ = {context_.buffer<uint32_t>(entries, {"wedge keys", advice::links}),
           context_.buffer<uint32_t>(entries, {"wedge order", advice::links}),
           context_.buffer<wt_wedge_prefix>(entries, {"wedge prefixes", advice::links}),
           context_.buffer<wt_wedge_prefix>(entries, {"wedge prefixes", advice::links})};
}

WedgePrefixList& WedgePrefixes::operator()(const DeviceScene& scene, const WedgeList& wedges, const RadioEnds& ends,
                                           const gpu::Buffer<uint64_t>& trie, const gpu::Buffer<uint32_t>& quarters,
                                           const gpu::Buffer<uint32_t>& nodes, uint32_t node_count,
                                           Counters& counters) {
  const Counters::Count count = &wt_counters::wedge_prefixes;
  const uint32_t lanes = lanes_of_ends(context_.info(), ends.most_ends);
  list_.count = grow_until_filled(  // read in each frame, since the sort needs it
      [&] {
        kernel_(work_.range(size_t{node_count} * lanes), Stage::wedge_prefixes,
                calls::wedge_prefixes::wedge_prefixes{
                    .table = trie,
                    .quarters = quarters,
                    .nodes = nodes,
                    .ends = ends.transmitters,
                    .first_ends = ends.first_ends,
                    .surfaces = scene.exact_surfaces,
                    .boxes = scene.surfaces,
                    .first_wedges = wedges.first,
                    .sides = wedges.sides,
                    .surface_wedges = wedges.of_surfaces,
                    .wedges = wedges.wedges,
                    .keys = list_.keys,
                    .prefixes = list_.prefixes,
                    .counters = counters.buffer(),
                    .args = wt_wedge_prefixes_arguments{static_cast<uint32_t>(trie.size() - 1), node_count,
                                                        static_cast<uint32_t>(list_.keys.size()), lanes}});
      },
      [&] { return counters.read(Stage::wedge_prefixes).*count; }, [&] { return list_.keys.size(); },
      [&](size_t entries) {
        reserve(entries);
        counters.restart(count, 0, Stage::wedge_prefixes);
      });
  return list_;
}

void WedgePrefixes::place(WedgePrefixList& list) {
  if (list.count > 0)
    place_(work_.range(list.count), Stage::wedge_prefixes,
           calls::wedge_prefixes::place_prefixes{.keys = list.keys,
                                                 .order = list.order,
                                                 .prefixes = list.prefixes,
                                                 .sorted = list.sorted,
                                                 .count = list.count});
}

}  // namespace wavetracer
