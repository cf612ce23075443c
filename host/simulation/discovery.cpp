// The wavefront loop.
// One host read a depth (the number of survivors); a batch whose sequences do not fit grows the set and is traced
// again. Queues of transmitted rays are traced depth first, so that at most one waits at each depth.
#include "simulation/discovery.hpp"

#include <algorithm>

namespace wavetracer {

namespace {

constexpr uint64_t initial_slots = 1 << 18;
constexpr uint64_t room_step = 256;  // room for rays is a multiple of this

// Depth of the sequences: wedges and tiles hang on surfaces that rays see, so these are wanted without reflection too.
uint32_t sequence_depth(const TraceConfig& config) {
  if (config.reflection) return config.max_depth;
  return config.diffraction || config.scattering ? std::min(1u, config.max_depth) : 0;
}

// Interactions of a ray. What is transmitted sees further surfaces, whether they reflect or not.
uint32_t ray_depth(const TraceConfig& config) {
  const uint32_t depth = sequence_depth(config);
  return depth > 0 && config.transmission ? config.max_depth : depth;
}

// Transmissions of a ray that may have so many interactions, the last of which ends it.
uint32_t ray_transmissions(const TraceConfig& config, uint32_t depth) {
  return config.transmission && depth > 0 ? std::min(config.max_transmissions, depth - 1) : 0;
}

// Rays in flight: what fills the device, and what its caches like where there are few cores. waiting: queues beside the
// two of the loop.
uint64_t choose_batch(const gpu::DeviceInfo& device, const TraceConfig& config, uint64_t waiting) {
  const uint64_t bytes_a_ray = 4 * ((2 + waiting) * WT_RAY_PLANES + WT_HIT_PLANES) + 4;
  const uint64_t most = std::min(device.max_buffer / (8 * WT_RAY_PLANES), device.global_memory / (4 * bytes_a_ray));
  const uint64_t wanted = config.batch_rays.value_or(uint64_t{1} << (device.cpu ? 18 : 25));
  return std::clamp<uint64_t>(wanted, 256, std::max<uint64_t>(most, 256));
}

// Packets win as long as neighbours in the queue travel together, which they do to the last depth once they were born
// or sorted in order.
TraceShape choose_shape(const gpu::DeviceInfo& device, const TraceConfig& config, const OrderPlan& order) {
  if (!device.cpu) return TraceShape::bvh2;
  return config.directions == "random" && !order.key ? TraceShape::bvh8 : TraceShape::packet16;
}

// Refined launches have no number of rays, but directions are made for one.
TraceConfig with_rays(TraceConfig config) {
  if (!config.rays) config.rays = 1;
  return config;
}

}  // namespace

std::vector<Launcher> launchers(const std::vector<glm::dvec3>& transmitters) {
  std::vector<Launcher> out;
  for (const glm::dvec3& position : transmitters) out.push_back({static_cast<uint32_t>(out.size()), position});
  return out;
}

Discovery::Discovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& config, const OrderPlan& order,
                     bool keep_ages)
    : context_(context),
      config_(with_rays(config)),
      plan_(order),
      max_depth_(sequence_depth(config)),
      depth_(ray_depth(config)),
      transmissions_(ray_transmissions(config, depth_)),
      batch_rays_(choose_batch(context.info(), config, transmissions_ > 0 ? depth_ - 1 : 0)),
      keep_ages_(keep_ages),
      shape_(choose_shape(context.info(), config, order)),
      directions_(config.directions, *config_.rays, config.seed),
      heights_(std::make_shared<LaunchHeights>(context)),
      generate_(context, directions_, heights_),
      trace_(context, scene, shape_, order.launch),
      scan_(context),
      interact_(context, keep_ages, false, false, transmissions_ > 0),
      sequences_(context, initial_slots, keep_ages) {
  if (!config.rays) {
    plan_ = {};  // refined launches go along their curve
    refinement_.emplace(context, config, heights_);
    interact_samples_.emplace(context, keep_ages, true, false, transmissions_ > 0);
  }
  if (plan_.key) order_.emplace(context, *plan_.key, plan_.bins, directions_, scene.extent_m, heights_);
  if (!trace_.counts_blocks()) compact_.emplace(context, Trace::block_size(context.info()));
}

void Discovery::use_cache(const DeviceScene& scene, const CacheConfig& config, const CacheWorld& world) {
  cache_.emplace(context_, scene, config, world, shape_, plan_.launch);
  if (!compact_) compact_.emplace(context_, Trace::block_size(context_.info()));
  label();
}

void Discovery::follow(RayTrails& trails) {
  trails_ = &trails;
  const gpu::DeviceInfo& device = context_.info();
  const uint64_t bytes = trails.bytes_a_sample();
  const uint64_t most = std::min(device.max_buffer / bytes, device.global_memory / (4 * bytes));
  batch_rays_ = std::min(batch_rays_, std::max(room_step, most / room_step * room_step));
  label();
}

void Discovery::label() {
  room_ = 0;  // what there is has other planes, or lacks a part
  if (label_) return;
  label_.emplace(context_);
  interact_ = Interact(context_, keep_ages_, false, true, transmissions_ > 0);
  if (refinement_) interact_samples_.emplace(context_, keep_ages_, true, true, transmissions_ > 0);
}

void Discovery::listen(uint64_t rays) {
  listener_rays_ = rays;
  listener_generate_.emplace(context_, LaunchDirections(config_.directions, rays, config_.seed), heights_);
}

DiscoveryCounts Discovery::operator()(const DeviceScene& scene, const std::vector<Launcher>& transmitters,
                                      DirectionShare share, LaunchedBy by) {
  by_ = by;
  DiscoveryCounts counts;
  counts.segments_per_depth.assign(segments(), 0);
  const uint64_t total = rays_of(share) * transmitters.size();
  if (segments() == 0 || total == 0) return counts;
  if (trails()) trails()->begin_launch();
  const uint64_t size = std::min(batch_rays_, total);
  reserve(size);
  for (uint64_t first = 0; first < total; first += size) {
    const Batch batch{first, std::min(size, total - first)};
    for (;;) {
      launch(transmitters, share, batch);
      trace_batch(scene, interact_, counts);
      if (!sequences_.overflowed()) break;
      sequences_.regrow(max_depth_);
    }
    if (trails()) trails()->end_batch();
    counts.rays += batch.count;
    tell(counts.rays, total);
  }
  return counts;
}

DiscoveryCounts Discovery::refined(const DeviceScene& scene, const std::vector<Launcher>& transmitters,
                                   uint64_t frame) {
  by_ = LaunchedBy::transmitters;
  DiscoveryCounts counts;
  counts.segments_per_depth.assign(depth_, 0);
  if (depth_ == 0 || transmitters.empty()) return counts;
  refinement_->start(transmitters, sequences_.table().size(), frame);
  for (bool more = true; more;) {
    trace_level(scene, counts);
    if (sequences_.overflowed()) {
      // Sequences get new numbers when the set grows: the launch begins again.
      sequences_.regrow(max_depth_);
      counts.rays = 0;
      refinement_->start(transmitters, sequences_.table().size(), frame);
    } else {
      more = refinement_->descend();
    }
  }
  counts.share_once = refinement_->share_once();
  counts.end = refinement_->end();
  return counts;
}

void Discovery::trace_level(const DeviceScene& scene, DiscoveryCounts& counts) {
  const SampleList& level = refinement_->level();
  for (uint64_t done = 0; done < level.count && !sequences_.overflowed(); done += batch_rays_) {
    const auto count = static_cast<uint32_t>(std::min<uint64_t>(batch_rays_, level.count - done));
    reserve(count);
    refinement_->generate(rays_, static_cast<uint32_t>(done), count);
    if (label_) (*label_)(rays_);
    trace_batch(scene, *interact_samples_, counts, &level.ends);
    counts.rays += count;
    tell(done + count, level.count);
  }
}

void Discovery::reserve(uint64_t rays) {
  if (rays <= room_) return;
  room_ = 0;  // until all parts have been made: what fits one of them fits them all
  rays = (rays + room_step - 1) / room_step * room_step;
  const uint32_t planes = label_ ? WT_RAY_LABELLED_PLANES : WT_RAY_PLANES + refinement_.has_value();
  rays_ = make_ray_queue(context_, rays, "rays", planes);
  next_ = make_ray_queue(context_, rays, "next rays", planes);
  hits_ = make_hit_list(context_, rays, Trace::block_size(context_.info()));
  if (transmissions_ > 0) {
    transmitted_.clear();
    for (uint32_t depth = 2; depth <= depth_; ++depth)
      transmitted_.push_back(make_ray_queue(context_, rays, "transmitted rays", planes));
  }
  if (order_) order_->reserve(rays);
  if (cache_) cache_->reserve(rays);
  if (trails_) trails_->reserve(rays);
  room_ = rays;
}

void Discovery::launch(const std::vector<Launcher>& transmitters, DirectionShare share, Batch batch) {
  const uint64_t rays = rays_of(share);
  const bool sorted = order_ && by_ == LaunchedBy::transmitters && share.stride == 1;
  GenerateRays& generate = by_ == LaunchedBy::listeners ? *listener_generate_ : generate_;
  rays_.count = 0;
  std::vector<LaunchPart> parts;
  for (uint64_t done = 0; done < batch.count;) {
    const uint64_t launch_index = batch.first + done, first = launch_index % rays;
    const Launcher& from = transmitters[launch_index / rays];
    const auto count = static_cast<uint32_t>(std::min(batch.count - done, rays - first));
    const auto sample = static_cast<uint32_t>(done);
    if (sorted) {
      const gpu::Buffer<uint32_t>& order = order_->launch(first, count, from.heights);
      generate(rays_, from, first, count, order);
      if (label_) (*label_)(rays_, sample, count, sample, order);
    } else {
      generate(rays_, from, share.phase + share.stride * first, count, share.stride);
      if (label_) (*label_)(rays_, sample, count, sample);
    }
    parts.push_back({from.transmitter, sample, count, first, rays, share.phase + share.stride * first, share.stride});
    done += count;
  }
  if (trails()) trails()->begin_batch(std::move(parts));
}

// Hits of the queue, and the hits of its blocks.
void Discovery::find_hits(const DeviceScene& scene, uint32_t depth) {
  const bool ask = cache_ && depth >= cache_->first_depth();
  if (ask)
    (*cache_)(scene, rays_, hits_, depth);
  else
    trace_(scene, rays_, hits_);
  if (trails()) {
    const std::optional<AnsweredRays> answered = ask ? cache_->answered() : std::nullopt;
    (*trails())(rays_, hits_, depth - 1, answered ? &*answered : nullptr);
  }
  if (ask || !trace_.counts_blocks())
    compact_->count_blocks(hits_.planes, size_t{WT_HIT_SURFACE} * hits_.capacity, rays_.count, hits_.block_hits);
}

void Discovery::trace_batch(const DeviceScene& scene, Interact& interact, DiscoveryCounts& counts,
                            const gpu::Buffer<uint32_t>* ends) {
  std::vector<Stage> waiting;
  trace_reflected(scene, interact, counts, {1, transmissions_}, waiting, ends);
  while (!waiting.empty()) {
    const Stage stage = waiting.back();
    waiting.pop_back();
    std::swap(rays_, transmitted_[stage.depth - 2]);
    // The end of a sample is that of the ray that was never transmitted.
    trace_reflected(scene, interact_, counts, stage, waiting, nullptr);
  }
}

void Discovery::trace_reflected(const DeviceScene& scene, Interact& interact, DiscoveryCounts& counts, Stage stage,
                                std::vector<Stage>& waiting, const gpu::Buffer<uint32_t>* ends) {
  const uint32_t block = Trace::block_size(context_.info());
  const uint32_t last = config_.reflection ? segments() : stage.depth;
  for (uint32_t depth = stage.depth; depth <= last && rays_.count > 0; ++depth) {
    if (plan_.each_depth && depth > 1) (*order_)(rays_, next_);
    find_hits(scene, depth);
    const uint32_t hit_count = scan_(hits_.block_hits, (rays_.count + block - 1) / block);
    const bool split = stage.transmissions > 0 && depth < depth_;
    if (depth <= depth_)
      interact(scene, rays_, hits_, hit_count, sequences_.table(), sequences_.quarters(), sequences_.counters(),
               sequences_.ages(), sequences_.now(), next_, depth == last, ends,
               split ? &transmitted_[depth - 1] : nullptr);
    if (split) waiting.push_back({depth + 1, stage.transmissions - 1});
    counts.segments_per_depth[depth - 1] += rays_.count;
    counts.hits += hit_count;
    std::swap(rays_, next_);
  }
}

}  // namespace wavetracer
