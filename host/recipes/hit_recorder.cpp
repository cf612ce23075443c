// The loop of host/simulation/discovery.cpp for one batch. Queues carry no launch index; compaction keeps the order, so
// the indices of the rays in a queue are those of the rays that hit before.
#include "recipes/hit_recorder.hpp"
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include "scene/load.hpp"

namespace wavetracer::recipes {
namespace {

// The largest absolute recentred coordinate.
double reach_m(const std::vector<glm::dvec3>& places_m, const glm::dvec3& origin_m) {
  double reach = 0;
  for (const glm::dvec3& place : places_m)
    for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(place[axis] - origin_m[axis]));
  return reach;
}

DeviceSummary summary(const gpu::DeviceInfo& info) {
  return {info.platform, info.name, info.driver, info.opencl_c, info.gpu};
}

// A plane of three-component vectors of a ray queue.
std::vector<glm::dvec3> read_vectors(const RayQueue& rays, size_t plane) {
  std::vector<glm::dvec3> out(rays.count);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float> component = rays.planes.read((plane + axis) * rays.capacity, rays.count);
    for (size_t i = 0; i < out.size(); ++i) out[i][axis] = component[i];
  }
  return out;
}

constexpr uint64_t table_slots = uint64_t{1} << 20;

}  // namespace

TracedScene::TracedScene(const Config& config, const std::string& device_text,
                         const std::vector<glm::dvec3>& transmitters_m)
    : context(device_text),
      scene(load_scene(config)),
      on_device(make_device_scene(context, scene, false, reach_m(transmitters_m, scene.origin_m))),
      device(summary(context.info())) {}

HitRecorder::HitRecorder(TracedScene& traced, const TraceConfig& trace)
    : traced_(traced),
      ray_count_(static_cast<uint32_t>(*trace.rays)),
      max_depth_(trace.max_depth),
      generate_(traced.context, LaunchDirections(trace.directions, *trace.rays, trace.seed)),
      trace_(traced.context, traced.on_device, traced.context.info().cpu ? TraceShape::bvh8 : TraceShape::bvh2),
      scan_(traced.context),
      interact_(traced.context),
      sequences_(traced.context, table_slots),
      rays_(make_ray_queue(traced.context, ray_count_, "rays")),
      next_(make_ray_queue(traced.context, ray_count_, "next rays")),
      hits_(make_hit_list(traced.context, ray_count_, Trace::block_size(traced.context.info()))) {}

report::FrameHits HitRecorder::operator()(const glm::dvec3& transmitter_m) {
  report::FrameHits out(max_depth_, std::vector<report::Hit>(ray_count_));
  std::vector<uint32_t> launch_index(ray_count_);  // of the rays in the queue
  std::iota(launch_index.begin(), launch_index.end(), 0);
  const uint32_t block = Trace::block_size(traced_.context.info());
  sequences_.clear();
  rays_.count = 0;
  generate_(rays_, {0, transmitter_m - traced_.scene.origin_m}, 0, ray_count_);
  for (uint32_t depth = 1; depth <= max_depth_ && rays_.count > 0; ++depth) {
    trace_(traced_.on_device, rays_, hits_);
    record(out[depth - 1], launch_index);
    const uint32_t hit_count = scan_(hits_.block_hits, (rays_.count + block - 1) / block);
    interact_(traced_.on_device, rays_, hits_, hit_count, sequences_.table(), sequences_.quarters(),
              sequences_.counters(), sequences_.ages(), sequences_.now(), next_, depth == max_depth_);
    std::swap(rays_, next_);
  }
  return out;
}

// Enters the hits of the queue, and leaves the launch indices of the rays that go on.
void HitRecorder::record(std::vector<report::Hit>& at, std::vector<uint32_t>& launch_index) const {
  const auto plane = [this](size_t which) { return hits_.planes.read(which * hits_.capacity, rays_.count); };
  const std::vector<glm::dvec3> origin = read_vectors(rays_, WT_RAY_ORIGIN),
                                direction = read_vectors(rays_, WT_RAY_DIRECTION);
  const std::vector<float> t = plane(WT_HIT_T), primitive = plane(WT_HIT_PRIMITIVE), surface = plane(WT_HIT_SURFACE);
  size_t kept = 0;
  for (size_t i = 0; i < launch_index.size(); ++i) {
    const auto hit_surface = std::bit_cast<uint32_t>(surface[i]);
    if (hit_surface == WT_NONE) continue;
    at[launch_index[i]] = {.point_m = origin[i] + double{t[i]} * direction[i],
                           .distance_m = t[i],
                           .surface = hit_surface,
                           .primitive = std::bit_cast<uint32_t>(primitive[i])};
    launch_index[kept++] = launch_index[i];
  }
  launch_index.resize(kept);
}

}  // namespace wavetracer::recipes
