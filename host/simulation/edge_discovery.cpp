// SPDX-License-Identifier: Apache-2.0
// The rays have a set of sequences of their own, whose roots are edges; it is empty at the begin of a frame.
#include "simulation/edge_discovery.hpp"

namespace wavetracer {
namespace {

// The rays of edges reflect once less than paths, which are also diffracted.
TraceConfig after_edges(TraceConfig trace) {
  trace.diffraction = trace.scattering = false;
  trace.max_depth -= 1;
  trace.reflection = trace.reflection && trace.max_depth > 0;
  trace.rays = trace.edge_rays;  // a fixed number
  return trace;
}

ListenerMap on_device(gpu::Context& context, const ListenerSquares& squares) {
  return {.listeners = context.buffer(squares.listeners, "squares of listeners"),
          .heights = context.buffer(squares.heights_m, "heights of listeners"),
          .x_m = static_cast<float>(squares.x_m),
          .y_m = static_cast<float>(squares.y_m),
          .size_m = static_cast<float>(squares.size_m),
          .columns = squares.columns,
          .rows = squares.rows,
          .low_m = squares.low_m,
          .high_m = squares.high_m};
}

}  // namespace

EdgeDiscovery::EdgeDiscovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& trace,
                             const Origins& origins, const FrameWatch& watch)
    : map_(on_device(context, *origins.squares)),
      edge_rays_(context, static_cast<uint32_t>(*trace.edge_rays), most_pieces, origins.count(), map_.low_m,
                 map_.high_m),
      hear_(context, origins.count(), origins.transmitter_count(), listener_margin_m),
      max_depth_(trace.max_depth),
      discovery_(context, scene, after_edges(trace), {.follower = this, .watch = &watch}) {}

DiscoveryCounts EdgeDiscovery::find(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                                    uint32_t in_sight, uint32_t listed, Sequences& into) {
  into_ = &into;
  discovery_.sequences().clear();
  const auto fill = [&](RayQueue& queue, uint64_t first, uint32_t count) {
    edge_rays_(queue, prefixes, wedges, first, count);  // edge_rays
  };
  const auto heard = [&] {
    if (!into.overflowed()) return true;
    into.regrow(max_depth_, listed);
    return false;
  };
  return discovery_.find_filled(scene, edge_rays_.total(in_sight), fill, heard);
}

void EdgeDiscovery::follow(const RayQueue& rays, const HitList& hits, uint32_t /*depth*/,
                           const std::optional<AnsweredRays>& /*answered*/) {
  hear_(rays, hits, discovery_.sequences().table(), map_, into_->trie());  // hear
}

}  // namespace wavetracer
