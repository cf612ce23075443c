// Host side of kernels/wedge_join.cl.
// A prefix has one work-item or a group of them: a wedge may be seen by few or by thousands.
#include "passes/wedge_join.hpp"

#include "passes/growing_list.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

WedgeJoin::WedgeJoin(gpu::Context& context, const std::vector<uint32_t>& receiver_of_origin, uint32_t max_depth,
                     bool pairs)
    : context_(context),
      join_(context.kernel("wedge_join", "wedge_join")),
      with_pairs_(pairs && max_depth >= 2),
      max_depth_(max_depth),
      lanes_(tuning_of(context.info()).join_lanes),
      group_(tuning_of(context.info()).join_group),
      receiver_of_origin_(context.buffer(receiver_of_origin, "receivers of origins")),
      list_(context.buffer<wt_wedge_candidate>(1 << 14, "wedge candidates")) {
  if (with_pairs_) pairs_ = context.kernel("wedge_join", "wedge_pairs");
}

uint32_t WedgeJoin::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                               const RadioEnds& ends, gpu::Buffer<wt_counters>& counters) {
  const size_t items = size_t{prefixes.count} * lanes_;
  const auto run = [&] {
    const wt_wedge_join_arguments arguments{.count = prefixes.count,
                                            .lanes = lanes_,
                                            .transmitter_count = ends.transmitter_count,
                                            .groups = ends.receiver_capacity / 16,
                                            .max_depth = max_depth_,
                                            .capacity = static_cast<uint32_t>(list_.size())};
    join_({items, group_}, "wedge_join", prefixes.keys, prefixes.order, prefixes.prefixes, receiver_of_origin_,
          ends.links, wedges.wedges, scene.surfaces, list_, counters, arguments);
    if (with_pairs_)
      pairs_({items, group_}, "wedge_join", prefixes.keys, prefixes.order, prefixes.prefixes, receiver_of_origin_,
             ends.links, wedges.wedges, list_, counters, arguments);
  };
  return fill_list(
      counters, &wt_counters::wedge_candidates, "wedge_join", [&] { return list_.size(); }, run,
      [&](size_t entries) { list_ = context_.buffer<wt_wedge_candidate>(entries, "wedge candidates"); });
}

}  // namespace wavetracer
