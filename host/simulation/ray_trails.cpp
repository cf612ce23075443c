// SPDX-License-Identifier: Apache-2.0
// Chosen samples are spread evenly over the launch indices of their transmitter. All samples of a batch leave waypoints
// on the device; the host reads those of chosen and of received samples.
#include "simulation/ray_trails.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

namespace wavetracer {

namespace {

// The chosen samples of this part, when `wanted` of all `launched` samples are chosen; counted from the part's first.
std::vector<uint32_t> chosen(const LaunchPart& part, uint64_t wanted) {
  std::vector<uint32_t> out;
  wanted = std::min(wanted, part.launched);
  if (wanted == 0) return out;
  // Number i is the sample in the middle of the i-th of `wanted` equal parts; with 128 bits the products never
  // overflow.
  const auto sample_of = [&](uint64_t i) {
    return static_cast<uint64_t>((static_cast<unsigned __int128>(2 * i + 1) * part.launched) / (2 * wanted));
  };
  uint64_t i = static_cast<uint64_t>(static_cast<unsigned __int128>(part.first) * wanted / part.launched);
  while (i > 0 && sample_of(i - 1) >= part.first) --i;
  for (; i < wanted && sample_of(i) < part.first + part.count; ++i)
    if (sample_of(i) >= part.first) out.push_back(static_cast<uint32_t>(sample_of(i) - part.first));
  return out;
}

}  // namespace

RayTrails::RayTrails(gpu::Context& context, const TraceConfig& trace, uint64_t samples_a_transmitter, uint32_t depth,
                     const SurfaceTable& surfaces)
    : wanted_(samples_a_transmitter), depth_(depth), surfaces_(surfaces), waypoints_(context, depth) {
  if (trace.by_spheres()) reception_.emplace(context, trace.sphere_radius_m);
}

void RayTrails::begin_frame(uint32_t frame, const RadioEnds& ends, const WorldState& world) {
  frame_ = frame;
  ends_ = ends;
  world_ = world;
  begin_launch();
}

void RayTrails::begin_launch() {
  rows_ = {};
  if (reception_) reception_->begin_launch();
}

void RayTrails::begin_batch(std::vector<LaunchPart> parts) {
  parts_ = std::move(parts);
  uint32_t count = 0;
  for (const LaunchPart& part : parts_) count += part.count;
  if (!parts_.empty()) waypoints_.begin_batch(parts_.front().first_sample, count);
  if (reception_) reception_->begin_batch();
}

void RayTrails::follow(const RayQueue& rays, const HitList& hits, uint32_t depth,
                       const std::optional<AnsweredRays>& answered) {
  if (rays.count == 0) return;
  waypoints_(rays, hits, depth, answered ? &answered->traced : nullptr);
  vehicles_cached_ = answered && answered->vehicles;
  if (!reception_) return;
  if (answered && answered->receivers)
    reception_->receive()(ends_, rays, hits, depth, answered->traced, *answered->receivers);
  else
    reception_->receive()(ends_, rays, hits, depth);
}

void RayTrails::first_receivers(const RayQueue& rays, const HitList& hits, gpu::Buffer<uint32_t>& first) {
  reception_->receive().first(ends_, rays, hits, first);
}

void RayTrails::end_batch() {
  std::vector<wt_reception> receptions;
  if (reception_) receptions = reception_->end_batch(waypoints_);
  if (wanted_ > 0) keep_waypoints(std::move(receptions));
}

// Distances along rays are float32, and their error grows with large triangles: the plane is known better.
glm::dvec3 RayTrails::on_surface(const glm::dvec3& position_m, const WorldPlace& place) const {
  const glm::dvec3 normal = surfaces_.normal(place, world_);
  double offset_m = surfaces_.surface(place).offset_m;
  if (place.instance != no_instance) offset_m += glm::dot(normal, world_.instances[place.instance].position_m);
  return position_m - (glm::dot(normal, position_m) - offset_m) * normal;
}

PathGeometry RayTrails::paths() const {
  PathGeometry out = reception_->paths();
  for (size_t i = 0; i < out.vertex.size(); ++i)
    out.vertex[i] = on_surface(out.vertex[i], surfaces_.at(out.surface[i]));
  return out;
}

void RayTrails::keep_waypoints(std::vector<wt_reception> receptions) {
  std::ranges::sort(receptions, {}, [](const wt_reception& r) { return std::tuple(r.sample, r.depth, r.receiver); });
  for (const LaunchPart& part : parts_) {
    std::vector<uint32_t> samples = chosen(part, wanted_);
    for (uint32_t& sample : samples) sample += part.first_sample;
    const std::vector<wt_waypoint> rows = waypoints_.rows(samples);
    for (size_t i = 0; i < samples.size(); ++i) {
      const auto hits = std::ranges::equal_range(receptions, samples[i], {}, &wt_reception::sample);
      add(part, samples[i], std::span(rows).subspan(i * waypoints_.stride(), waypoints_.stride()), hits);
    }
  }
}

WaypointSource RayTrails::source_of(const wt_waypoint& end) const {
  const bool on_surface = end.surface != WT_WAYPOINT_LAUNCH && end.surface != WT_WAYPOINT_MISS;
  const bool on_vehicle = on_surface && surfaces_.at(end.surface).instance != no_instance;
  if (!end.answered || (on_vehicle && !vehicles_cached_)) return WaypointSource::traced;
  return WaypointSource::cache;
}

// Adds one sample: its launch, then for every segment its hits and its end, up to a miss.
void RayTrails::add(const LaunchPart& part, uint32_t sample, std::span<const wt_waypoint> row,
                    std::span<const wt_reception> hits) {
  const glm::dvec3& origin_m = surfaces_.scene(0).origin_m;
  const auto push = [&](uint32_t depth, WaypointKind kind, const glm::dvec3& position_m, uint32_t surface,
                        uint32_t instance, WaypointSource source) {
    rows_.frame.push_back(frame_);
    rows_.tx.push_back(part.transmitter);
    rows_.sample.push_back(part.first_index + part.stride * (sample - part.first_sample));
    rows_.depth.push_back(depth);
    rows_.kind.push_back(kind);
    rows_.position_m.push_back(position_m);
    rows_.surface.push_back(surface);
    rows_.instance.push_back(instance);
    rows_.source.push_back(source);
  };
  glm::dvec3 start_m{0};  // start of the segment that ends in k
  for (uint32_t k = 0; k <= row.size(); ++k) {
    for (; !hits.empty() && hits.front().depth + 1 == k; hits = hits.subspan(1))
      push(k, WaypointKind::hit, origin_m + world_.receivers[hits.front().receiver].position_m, hits.front().receiver,
           no_instance, k < row.size() ? source_of(row[k]) : WaypointSource::unknown);
    if (k == row.size()) break;  // the last ones are hits of the segment after the last interaction
    const glm::dvec3 position_m{row[k].position[0], row[k].position[1], row[k].position[2]};
    if (row[k].surface == WT_WAYPOINT_LAUNCH) {
      push(k, WaypointKind::launch, origin_m + position_m, no_surface, no_instance, WaypointSource::launch);
    } else if (row[k].surface == WT_WAYPOINT_MISS) {
      push(k, WaypointKind::miss, start_m + position_m, no_surface, no_instance, source_of(row[k]));
      break;
    } else {
      const WorldPlace place = surfaces_.at(row[k].surface);
      push(k, WaypointKind::reflection, origin_m + on_surface(position_m, place), place.index, place.instance,
           source_of(row[k]));
    }
    start_m = rows_.position_m.back();
  }
}

}  // namespace wavetracer
