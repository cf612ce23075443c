// Host side of kernels/wedge_join.cl.
// A prefix has one work-item or a group of them: a wedge may be seen by few or by thousands.
#include "passes/wedge_join.hpp"

#include "passes/growing_list.hpp"
#include "passes/tuning.hpp"

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
  const uint32_t groups = ends.receiver_capacity / 16;
  const size_t items = size_t{prefixes.count} * lanes_;
  const auto run = [&] {
    const auto capacity = static_cast<uint32_t>(list_.size());
    join_({items, group_}, "wedge_join", prefixes.keys, prefixes.order, prefixes.prefixes, prefixes.count, lanes_,
          ends.transmitter_count, receiver_of_origin_, ends.links, groups, max_depth_, wedges.wedges, scene.surfaces,
          list_, capacity, counters);
    if (with_pairs_)
      pairs_({items, group_}, "wedge_join", prefixes.keys, prefixes.order, prefixes.prefixes, prefixes.count, lanes_,
             ends.transmitter_count, receiver_of_origin_, ends.links, groups, max_depth_, wedges.wedges, list_,
             capacity, counters);
  };
  return fill_list(
      counters, &wt_counters::wedge_candidates, "wedge_join", [&] { return list_.size(); }, run,
      [&](size_t entries) { list_ = context_.buffer<wt_wedge_candidate>(entries, "wedge candidates"); });
}

}  // namespace wavetracer
