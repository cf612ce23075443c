// SPDX-License-Identifier: Apache-2.0
// A batch that is traced again, because its sequences did not fit, records the same hits again.
// Labels of rays give their samples, in any order of the queues.
#include "study/hit_recorder.hpp"
#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include "scene/load.hpp"
#include "simulation/device_proof.hpp"
#include "simulation/listeners.hpp"
#include "simulation/scene_on_device.hpp"

namespace wavetracer::study {
namespace {

DeviceSummary summary(const gpu::DeviceInfo& info) {
  return {info.platform, info.name, info.driver, info.opencl_c, info.gpu};
}

// Experiments on hits use reflections only, of as many rays as the configuration says.
TraceConfig reflections(TraceConfig trace) {
  trace.reflection = true;
  trace.diffraction = trace.transmission = trace.scattering = false;
  return trace;
}

// Reads a plane of three-component vectors of a ray queue.
std::vector<glm::dvec3> read_vectors(const RayQueue& rays, size_t plane) {
  std::vector<glm::dvec3> out(rays.count);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float> component = rays.planes.read((plane + axis) * rays.capacity, rays.count);
    for (size_t i = 0; i < out.size(); ++i) out[i][axis] = component[i];
  }
  return out;
}

}  // namespace

TracedWorld::TracedWorld(const Config& config, const std::string& device_text)
    : context(device_text),
      scene(load_scene(config)),
      world(make_world(config, scene)),
      on_device(make_device_scene(context, scene, false, world.reach_m)),
      device(summary(context.info())) {
  prove_device(context, {.instances = !world.fleet.instances.empty()});
  auto [placed, places] = place_instances(context, std::move(on_device), scene, world);
  on_device = std::move(placed);
  if (places) placement.emplace(std::move(*places));
}

Drive plan_drive(const TracedWorld& traced, uint32_t frames, uint32_t least, const std::string& where) {
  return plan_drive(
      traced.world.transmitters.ends, [&](uint32_t frame) { return traced.world.state(frame); },
      traced.world.clock.frame_count(), traced.scene.origin_m, frames, least, where);
}

HitRecorder::HitRecorder(TracedWorld& traced, const TraceConfig& trace)
    : traced_(traced),
      trace_(reflections(trace)),
      discovery_(traced.context, traced.on_device, trace_, {.follower = this}) {}

FrameHits HitRecorder::operator()(uint32_t transmitter, uint32_t frame) {
  found_.assign(trace_.max_depth, std::vector<Hit>(*trace_.rays));
  const WorldState world = traced_.world.state(frame);
  if (traced_.placement) traced_.placement->place(traced_.on_device, world.instances);
  discovery_.sequences().clear();
  discovery_.sequences().begin_frame();
  discovery_.find(traced_.on_device, {.who = {launcher_of(0, world.transmitters[transmitter])}, .rays = *trace_.rays});
  return std::move(found_);
}

uint64_t HitRecorder::launch_index(uint32_t sample) const {
  for (const LaunchPart& part : parts_)
    if (sample - part.first_sample < part.count) return part.first_index + part.stride * (sample - part.first_sample);
  throw std::logic_error("a ray belongs to no part of its launch");
}

void HitRecorder::follow(const RayQueue& rays, const HitList& hits, uint32_t depth,
                         const std::optional<AnsweredRays>& /*answered*/) {
  const auto plane = [&](size_t which) { return hits.planes.read(which * hits.capacity, rays.count); };
  const std::vector<glm::dvec3> origin = read_vectors(rays, WT_RAY_ORIGIN),
                                direction = read_vectors(rays, WT_RAY_DIRECTION);
  const std::vector<float> sample = rays.planes.read(size_t{WT_RAY_SAMPLE} * rays.capacity, rays.count),
                           t = plane(WT_HIT_T), primitive = plane(WT_HIT_PRIMITIVE), surface = plane(WT_HIT_SURFACE);
  for (size_t i = 0; i < rays.count; ++i)
    if (const auto hit_surface = std::bit_cast<uint32_t>(surface[i]); hit_surface != WT_NONE)
      found_[depth][launch_index(std::bit_cast<uint32_t>(sample[i]))] = {
          .point_m = origin[i] + double{t[i]} * direction[i],
          .distance_m = t[i],
          .surface = hit_surface,
          .primitive = std::bit_cast<uint32_t>(primitive[i])};
}

}  // namespace wavetracer::study
