// Host side of kernels/wedge_join.cl.
// A prefix has one work-item or a group of them: a wedge may be seen by few or by thousands.
#include "passes/wedge_join.hpp"

#include "passes/growing_list.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

WedgeJoin::WedgeJoin(gpu::Context& context, const std::vector<uint32_t>& receiver_of_origin, uint32_t max_depth)
    : context_(context),
      kernel_(context.kernel("wedge_join", "wedge_join")),
      max_depth_(max_depth),
      lanes_(tuning_of(context.info()).join_lanes),
      group_(tuning_of(context.info()).join_group),
      receiver_of_origin_(context.buffer(receiver_of_origin, "receivers of origins")),
      list_(context.buffer<wt_wedge_candidate>(1 << 14, "wedge candidates")) {}

uint32_t WedgeJoin::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                               const RadioEnds& ends, Counters& counters, WedgePairs* pairs) {
  const size_t items = size_t{prefixes.count} * lanes_;
  const auto run = [&] {
    const wt_wedge_join_arguments arguments{.count = prefixes.count,
                                            .lanes = lanes_,
                                            .transmitter_count = ends.transmitter_count,
                                            .groups = ends.receiver_capacity / 16,
                                            .max_depth = max_depth_,
                                            .capacity = static_cast<uint32_t>(list_.size())};
    kernel_({items, group_}, "wedge_join", prefixes.keys, prefixes.order, prefixes.prefixes, receiver_of_origin_,
            ends.links, wedges.wedges, scene.surfaces, list_, counters.buffer(), arguments);
    if (pairs && max_depth_ >= 2)
      (*pairs)(scene, prefixes, wedges, ends, receiver_of_origin_, arguments, list_, counters);
  };
  return fill_list(
      counters, &wt_counters::wedge_candidates, "wedge_join", [&] { return list_.size(); }, run,
      [&](size_t entries) { list_ = context_.buffer<wt_wedge_candidate>(entries, "wedge candidates"); });
}

}  // namespace wavetracer
