// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/wedge_pairs.cl.
#include "passes/wedge_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "passes/tuning.hpp"

namespace wavetracer {
namespace {

// The number of wedges for which the bits of known pairs are kept; their memory is limited to this, 23,000 wedges. If
// there are more, each frame tests the last ones again; corners are last.
uint32_t kept_wedges(const gpu::DeviceInfo& device, uint64_t wedges) {
  const uint64_t most = std::min({uint64_t{1} << 31, device.max_buffer, device.global_memory / 16});
  const auto room = static_cast<uint64_t>(std::sqrt(static_cast<double>(most) / sizeof(wt_uint)));
  return static_cast<uint32_t>(std::min(wedges, room));
}

}  // namespace

WedgePairs::WedgePairs(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, bool transmission,
                       BendFloors floors)
    : sight(context, device_scene, scene, transmission),
      context_(context),
      kernel_(context, device_scene.definitions),
      mark_(context, device_scene.definitions),
      mark_work_(tuning_of(context.info()).exact),
      compact_(context),
      scan_(context),
      lanes_(tuning_of(context.info()).pairs_lanes),
      group_(tuning_of(context.info()).pairs_group),
      kept_wedges_(kept_wedges(context.info(), scene.wedges.size())),
      kept_(context.buffer<uint32_t>(std::max<size_t>(size_t{kept_wedges_} * kept_wedges_, 1), "pairs of wedges")),
      floor_(static_cast<float>(floors.two)) {
  context.fill(kept_, 0, Stage::wedge_pairs);
}

void WedgePairs::list_runs(const WedgeList& wedges, const WedgePrefixList& prefixes) {
  if (heads_.size() < prefixes.count) {
    heads_ = context_.buffer<float>(prefixes.keys.size(), "heads of runs");
    runs_ = context_.buffer<uint32_t>(prefixes.keys.size(), "runs of prefixes");
    blocks_ = context_.buffer<uint32_t>(compact_.blocks(static_cast<uint32_t>(heads_.size())) + 1, "blocks of runs");
  }
  run_count_ = 0;
  if (prefixes.count == 0) return;
  mark_(mark_work_.range(prefixes.count), Stage::wedge_pairs,
        calls::wedge_pairs::mark_runs{.keys = prefixes.keys,
                                      .wedges = wedges.wedges,
                                      .heads = gpu::Global<uint32_t>::bits_of(heads_),
                                      .count = prefixes.count});
  compact_.count_blocks(heads_, 0, prefixes.count, blocks_);
  run_count_ = scan_(blocks_, compact_.blocks(prefixes.count), Stage::wedge_pairs);
  compact_(heads_, 0, prefixes.count, blocks_, runs_);
}

void WedgePairs::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                            const RadioEnds& ends, const wt_wedge_join_arguments& join,
                            const gpu::Buffer<wt_wedge_candidate>& list, Counters& counters) {
  wt_wedge_join_arguments own = join;
  own.lanes = lanes_;
  own.floor = floor_;
  kernel_({size_t{join.end - join.first} * lanes_, group_}, Stage::wedge_pairs,
          calls::wedge_pairs::wedge_pairs{.nodes = scene.leg_nodes(),
                                          .triangles = scene.leg_leaves(),
                                          .surfaces = scene.exact_surfaces,
                                          .first_sides = sight.first_sides(),
                                          .sides = sight.sides(),
                                          .kept = kept_,
                                          .keys = prefixes.keys,
                                          .runs = runs_,
                                          .prefixes = prefixes.sorted,
                                          .receiver_of_end = ends.receiver_of_end,
                                          .links = ends.links,
                                          .wedges = wedges.wedges,
                                          .out = list,
                                          .counters = counters.buffer(),
                                          .args = own,
                                          .sight_args = sight.arguments(scene, join.count, kept_wedges_),
                                          .run_count = run_count_});
}

}  // namespace wavetracer
