// SPDX-License-Identifier: Apache-2.0
// The loop follows the table of docs/architecture.md, from the sort of a queue to interact.
#include "simulation/wavefront.hpp"

#include <utility>

namespace wavetracer {

namespace {

// Rays lose their sample when they are transmitted, and where no launch is refined.
InteractOptions without_samples(InteractOptions options) {
  options.samples = false;
  return options;
}

}  // namespace

Wavefront::Wavefront(gpu::Context& context, const DeviceScene& scene, const TracingDepth& depth,
                     InteractOptions options, bool at_once, RaySource& source, HitFinder& finder, Sequences& sequences)
    : context_(context),
      depth_(depth),
      planes_(options.labels ? WT_RAY_LABELLED_PLANES : WT_RAY_PLANES + uint32_t{options.samples}),
      source_(source),
      finder_(finder),
      sequences_(sequences),
      scan_(context),
      interact_(context, without_samples(options)) {
  if (options.samples) interact_samples_.emplace(context, options);
  if (!at_once) return;
  bounces_.emplace(context, scene, options.ages, false);
  if (options.samples) bounces_samples_.emplace(context, scene, options.ages, true);
}

void Wavefront::reserve(uint64_t rays) {
  rays_ = make_ray_queue(context_, rays, "rays", planes_);
  next_ = make_ray_queue(context_, rays, "next rays", planes_);
  hits_ = make_hit_list(context_, rays);
  transmitted_.clear();
  for (uint32_t depth = 2; depth_.transmissions > 0 && depth <= depth_.interactions; ++depth)
    transmitted_.push_back(make_ray_queue(context_, rays, "transmitted rays", planes_));
}

bool Wavefront::trace(const DeviceScene& scene, RayFollower& follower, DiscoveryCounts& counts,
                      const gpu::Buffer<uint32_t>* ends) {
  if (bounces_) return trace_at_once(scene, ends ? *bounces_samples_ : *bounces_, ends, counts);  // bounces
  waiting_.clear();
  trace_reflected(scene, follower, counts, {1, depth_.transmissions}, ends);
  while (!waiting_.empty()) {
    const Waiting from = waiting_.back();
    waiting_.pop_back();
    std::swap(rays_, transmitted_[from.depth - 2]);
    // The end of a sample is that of the ray that was never transmitted.
    trace_reflected(scene, follower, counts, from, nullptr);
  }
  return !sequences_.overflowed();
}

bool Wavefront::trace_at_once(const DeviceScene& scene, Bounces& bounces, const gpu::Buffer<uint32_t>* ends,
                              DiscoveryCounts& counts) {
  Counters& counters = sequences_.counters();
  if (!counters.foresees()) counters.restart_ended(Stage::trace);
  bounces(scene, rays_, depth_.interactions, sequences_.trie(), ends);
  if (counters.foresees()) {
    counts.unread += rays_.count;
    return true;
  }
  const wt_counters after = counters.read(Stage::trace);
  counts.add_ended(rays_.count, after.ended);
  return after.trie_overflow == 0;
}

void Wavefront::trace_reflected(const DeviceScene& scene, RayFollower& follower, DiscoveryCounts& counts, Waiting from,
                                const gpu::Buffer<uint32_t>* ends) {
  Interact& interact = ends ? *interact_samples_ : interact_;
  const uint32_t last = depth_.reflections > 0 ? segments(follower) : from.depth;
  for (uint32_t depth = from.depth; depth <= last && rays_.count > 0; ++depth) {
    source_.sort(rays_, next_, depth);         // order_keys, sort, gather_rays
    finder_.find(scene, rays_, hits_, depth);  // cache_lookup, trace, cache_store (ray_cache.cpp)
    follower.follow(rays_, hits_, depth - 1, finder_.answered(depth));              // waypoints, receive
    finder_.count_blocks(rays_, hits_, depth);                                      // compact
    const uint32_t hit_count = scan_(hits_.block_hits, hits_.blocks(rays_.count));  // scan
    RaysOnward onward{.reflected = depth == last ? nullptr : &next_, .ends = ends};
    if (from.transmissions > 0 && depth < depth_.interactions) {
      onward.transmitted = &transmitted_[depth - 1];
      waiting_.push_back({depth + 1, from.transmissions - 1});
    }
    if (depth <= depth_.interactions) interact(scene, rays_, hits_, hit_count, sequences_.trie(), onward);  // interact
    counts.segments_per_depth[depth - 1] += rays_.count;
    counts.hits += hit_count;
    std::swap(rays_, next_);
  }
}

}  // namespace wavetracer
