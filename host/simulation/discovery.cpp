// SPDX-License-Identifier: Apache-2.0
// Runs batches of a launch, and levels of a refined one, through the wavefront loop.
#include "simulation/discovery.hpp"

#include <algorithm>

namespace wavetracer {

namespace {

constexpr uint64_t initial_slots = 1 << 18;
constexpr uint64_t room_step = 256;  // room for rays is a multiple of this

// The number of rays in flight: that tuned for the device where memory and the configuration allow it.
uint64_t choose_batch(const gpu::DeviceInfo& device, const TraceConfig& trace, const TracingDepth& depth,
                      const RayFollower& follower) {
  const uint64_t waiting = depth.transmissions > 0 ? depth.interactions - 1 : 0;  // queues beside the two of the loop
  const uint64_t bytes_per_ray = 4 * ((2 + waiting) * WT_RAY_PLANES + WT_HIT_PLANES) + 4;
  const uint64_t most = std::min(device.max_buffer / (8 * WT_RAY_PLANES), device.global_memory / (4 * bytes_per_ray));
  const uint64_t wanted = trace.batch_rays.value_or(tuning_of(device).batch_rays);
  const uint64_t rays = std::clamp<uint64_t>(wanted, room_step, std::max<uint64_t>(most, room_step));
  const uint64_t followed = follower.bytes_per_sample();
  if (followed == 0) return rays;
  const uint64_t samples = std::min(device.max_buffer / followed, device.global_memory / (4 * followed));
  return std::min(rays, std::max(room_step, samples / room_step * room_step));
}

// A launch with a fixed number of rays follows the plan; refined launches go along their curve.
OrderPlan order_of(const TraceConfig& trace, const OrderPlan& plan) { return trace.rays ? plan : OrderPlan{}; }

// Rays in queues are labelled where a cache or a follower must know their transmitter and sample.
bool needs_labels(const DiscoveryOptions& options) { return options.finder || options.follower; }

InteractOptions interact_options(const TraceConfig& trace, const TracingDepth& depth, const DiscoveryOptions& options) {
  return {.ages = options.keep_ages,
          .samples = !trace.rays,
          .labels = needs_labels(options),
          .transmission = depth.transmissions > 0};
}

// Are rays only reflected between two depths? Then they need no queues. On CPUs packets of rays through queues are
// faster.
bool at_once(const gpu::DeviceInfo& device, const TracingDepth& depth, const DiscoveryOptions& options) {
  return !device.cpu && !needs_labels(options) && depth.transmissions == 0 && !options.order.each_depth &&
         options.order.launch.plain();
}

}  // namespace

Discovery::Discovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& trace,
                     const DiscoveryOptions& options)
    : depth_(tracing_depth(trace)),
      follower_(options.follower ? *options.follower : nobody_),
      watch_(options.watch),
      batch_rays_(choose_batch(context.info(), trace, depth_, follower_)),
      source_(context, trace, order_of(trace, options.order), needs_labels(options), scene.extent_m),
      finder_(options.finder ? *options.finder
                             : traced_.emplace(context, scene, choose_shape(context.info(), trace, options.order),
                                               options.order.launch)),
      sequences_(context, initial_slots, options.keep_ages),
      wavefront_(context, scene, depth_, interact_options(trace, depth_, options),
                 at_once(context.info(), depth_, options), source_, finder_, sequences_) {
  if (!trace.rays) refinement_.emplace(context, trace, source_.heights(), options.hilly);
}

template <class Fill>
void Discovery::trace_batch(const DeviceScene& scene, RayFollower& follower, DiscoveryCounts& counts,
                            const Fill& fill) {
  for (bool fits = false; !fits;) {
    wavefront_.rays().count = 0;
    fill(wavefront_.rays());
    fits = wavefront_.trace(scene, follower, counts);  // order_keys (of later depths) to interact, or bounces
    if (!fits) sequences_.regrow(depth_.sequences);
  }
}

DiscoveryCounts Discovery::find(const DeviceScene& scene, const Launch& launch) {
  RayFollower& follower = launch.followed ? follower_ : nobody_;
  DiscoveryCounts counts = nothing_yet(follower);
  const uint64_t total = launch.total();
  if (counts.segments_per_depth.empty() || total == 0) return counts;
  counts.rays_each = static_cast<double>(launch.rays_each());
  follower.begin_launch();
  const uint64_t size = std::min(batch_rays_, total);
  reserve(size);
  while (counts.rays < total) {
    const uint64_t count = std::min(size, total - counts.rays);
    trace_batch(scene, follower, counts, [&](RayQueue& rays) {
      follower.begin_batch(source_.launch(rays, launch, counts.rays, count));  // order_keys to label_rays
    });
    follower.end_batch();
    counts.rays += count;
    tell(counts.rays, total);
  }
  return counts;
}

DiscoveryCounts Discovery::find_all(const DeviceScene& scene, std::span<const Launch> launches) {
  DiscoveryCounts counts = nothing_yet(nobody_);
  uint64_t total = 0;
  for (const Launch& launch : launches) total += launch.total();
  if (launches.size() == 1 || total > batch_rays_ || &follower_ != &nobody_ || !source_.as_launched()) {
    for (const Launch& launch : launches) counts.add(find(scene, launch));
    return counts;
  }
  if (counts.segments_per_depth.empty() || total == 0) return counts;
  reserve(total);
  trace_batch(scene, nobody_, counts, [&](RayQueue& rays) {
    for (const Launch& launch : launches) source_.launch(rays, launch, 0, launch.total());
  });
  counts.rays = total;
  counts.rays_each = static_cast<double>(launches.front().rays_each());
  tell(total, total);
  return counts;
}

DiscoveryCounts Discovery::find_filled(const DeviceScene& scene, uint64_t total,
                                       const std::function<void(RayQueue&, uint64_t, uint32_t)>& fill,
                                       const std::function<bool()>& done) {
  DiscoveryCounts counts = nothing_yet(follower_);
  const uint64_t size = std::min(batch_rays_, total);
  if (total > 0) reserve(size);
  while (counts.rays < total) {
    const auto count = static_cast<uint32_t>(std::min(size, total - counts.rays));
    trace_batch(scene, follower_, counts, [&](RayQueue& rays) {
      fill(rays, counts.rays, count);
      source_.label(rays);
    });
    if (done()) counts.rays += count;
  }
  return counts;
}

DiscoveryCounts Discovery::nothing_yet(RayFollower& follower) const {
  DiscoveryCounts counts;
  counts.segments_per_depth.assign(wavefront_.segments(follower), 0);
  return counts;
}

DiscoveryCounts Discovery::find_refined(const DeviceScene& scene, const std::vector<Launcher>& who, uint64_t frame) {
  DiscoveryCounts counts = nothing_yet(nobody_);
  if (counts.segments_per_depth.empty() || who.empty()) return counts;
  refinement_->start(who, sequences_.table().size(), frame);
  for (bool more = true; more;) {
    if (!trace_level(scene, counts)) {  // sequences get new numbers: the launch begins again
      sequences_.regrow(depth_.sequences);
      counts.rays = 0;
      refinement_->start(who, sequences_.table().size(), frame);
    } else {
      more = refinement_->descend();  // refine
    }
  }
  counts.rays_each = static_cast<double>(counts.rays) / static_cast<double>(who.size());
  counts.share_once = refinement_->share_once();
  counts.end = refinement_->end();
  return counts;
}

bool Discovery::trace_level(const DeviceScene& scene, DiscoveryCounts& counts) {
  const SampleList& level = refinement_->level();
  for (uint64_t done = 0; done < level.count; done += batch_rays_) {
    const auto count = static_cast<uint32_t>(std::min<uint64_t>(batch_rays_, level.count - done));
    reserve(count);
    refinement_->generate(wavefront_.rays(), static_cast<uint32_t>(done), count);  // generate_rays
    source_.label(wavefront_.rays());                                              // label_rays
    if (!wavefront_.trace(scene, nobody_, counts, &level.ends)) return false;
    counts.rays += count;
    tell(done + count, level.count);
  }
  return true;
}

void Discovery::reserve(uint64_t rays) {
  if (rays <= room_) return;
  room_ = 0;  // until all parts are made: a number that fits one of them fits them all
  rays = (rays + room_step - 1) / room_step * room_step;
  wavefront_.reserve(rays);
  source_.reserve(rays);
  finder_.reserve(rays);
  follower_.reserve(rays);
  room_ = rays;
}

}  // namespace wavetracer
