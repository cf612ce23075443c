// The wavefront loop.
// One host read a depth (the number of survivors); a batch whose sequences do not fit grows the set and is traced
// again.
#include "simulation/discovery.hpp"

#include <algorithm>

namespace wavetracer {

namespace {

constexpr uint64_t initial_slots = 1 << 18;

// Rays in flight: what fills the device, and what its caches like where there are few cores.
uint64_t choose_batch(const gpu::DeviceInfo& device, const TraceConfig& config) {
  constexpr uint64_t bytes_a_ray = 4 * (2 * WT_RAY_PLANES + WT_HIT_PLANES) + 4;
  const uint64_t most = std::min(device.max_buffer / (8 * WT_RAY_PLANES), device.global_memory / (4 * bytes_a_ray));
  const uint64_t wanted = config.batch_rays ? config.batch_rays : device.cpu ? uint64_t{1} << 18 : uint64_t{1} << 25;
  return std::clamp<uint64_t>(wanted, 256, std::max<uint64_t>(most, 256));
}

// Packets win as long as neighbours in the queue travel together, which they do to the last depth once they were born
// or sorted in order.
TraceShape choose_shape(const gpu::DeviceInfo& device, const TraceConfig& config, const OrderPlan& order) {
  if (!device.cpu) return TraceShape::bvh2;
  return config.directions == "random" && !order.key ? TraceShape::bvh8 : TraceShape::packet16;
}

}  // namespace

Discovery::Discovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& config, const OrderPlan& order)
    : context_(context),
      config_(config),
      plan_(order),
      max_depth_(config.reflection ? config.max_depth : 0),
      batch_rays_(choose_batch(context.info(), config)),
      directions_(config.directions, config.rays, config.seed),
      generate_(context, directions_),
      trace_(context, scene, choose_shape(context.info(), config, order), order.launch),
      scan_(context),
      interact_(context),
      sequences_(context, initial_slots) {
  if (!trace_.counts_blocks()) compact_.emplace(context, Trace::block_size(context.info()));
}

DiscoveryCounts Discovery::operator()(const DeviceScene& scene, const std::vector<glm::dvec3>& transmitters) {
  DiscoveryCounts counts;
  counts.segments_per_depth.assign(max_depth_, 0);
  sequences_.clear();
  if (max_depth_ == 0) return counts;
  const uint64_t total = config_.rays * transmitters.size();
  const uint64_t size = std::min(batch_rays_, total);
  if (rays_.capacity < padded_capacity(size)) {
    rays_ = make_ray_queue(context_, size, "rays");
    next_ = make_ray_queue(context_, size, "next rays");
    hits_ = make_hit_list(context_, size, Trace::block_size(context_.info()));
    if (plan_.key)
      order_.emplace(context_, *plan_.key, plan_.bins, directions_, scene.extent_m, static_cast<uint32_t>(size));
  }
  for (uint64_t first = 0; first < total; first += size) {
    const Batch batch{first, std::min(size, total - first)};
    for (;;) {
      launch(transmitters, batch);
      trace_batch(scene, counts);
      if (!sequences_.overflowed()) break;
      sequences_.regrow(max_depth_);
    }
    counts.rays += batch.count;
  }
  return counts;
}

void Discovery::launch(const std::vector<glm::dvec3>& transmitters, Batch batch) {
  rays_.count = 0;
  for (uint64_t done = 0; done < batch.count;) {
    const uint64_t launch_index = batch.first + done, first = launch_index % config_.rays;
    const auto transmitter = static_cast<uint32_t>(launch_index / config_.rays);
    const auto count = static_cast<uint32_t>(std::min(batch.count - done, config_.rays - first));
    if (order_)
      generate_(rays_, transmitter, transmitters[transmitter], first, count, order_->launch(first, count));
    else
      generate_(rays_, transmitter, transmitters[transmitter], first, count);
    done += count;
  }
}

void Discovery::trace_batch(const DeviceScene& scene, DiscoveryCounts& counts) {
  const uint32_t block = Trace::block_size(context_.info());
  for (uint32_t depth = 1; depth <= max_depth_ && rays_.count > 0; ++depth) {
    if (plan_.each_depth && depth > 1) (*order_)(rays_, next_);
    trace_(scene, rays_, hits_);
    if (compact_)
      compact_->count_blocks(hits_.planes, size_t{WT_HIT_SURFACE} * hits_.capacity, rays_.count, hits_.block_hits);
    const uint32_t hit_count = scan_(hits_.block_hits, (rays_.count + block - 1) / block);
    interact_(scene, rays_, hits_, hit_count, sequences_.table(), sequences_.counters(), next_, depth == max_depth_);
    counts.segments_per_depth[depth - 1] += rays_.count;
    counts.hits += hit_count;
    std::swap(rays_, next_);
  }
}

}  // namespace wavetracer
