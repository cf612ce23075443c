// What is followed along rays besides their sequences: which receivers they pass (trace.reception = "sphere"), and the
// waypoints of some of them (output.waypoints). Discovery calls it batch by batch and depth by depth.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "passes/waypoints.hpp"
#include "radio/surface_table.hpp"
#include "simulation/sphere_reception.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/ray_waypoints.hpp"

namespace wavetracer {

// Samples of one transmitter that follow each other in a batch: sample first_sample + k has launch index
// first_index + k * stride, and is number first + k of the `launched` samples of its transmitter, of which some are
// chosen for the output.
struct LaunchPart {
  uint32_t transmitter, first_sample, count;
  uint64_t first, launched;
  uint64_t first_index, stride = 1;
};

// Rays that a cache has answered, see Receive.
struct AnsweredRays {
  const gpu::Buffer<float>& traced;
  const gpu::Buffer<uint32_t>& receivers;
};

class RayTrails {
 public:
  // depth: most interactions of a ray. The scenes that `surfaces` refers to must outlive this.
  RayTrails(gpu::Context& context, const TraceConfig& trace, uint64_t samples_a_transmitter, uint32_t depth,
            const SurfaceTable& surfaces);
  // Are receptions wanted? Then rays need a segment after their last interaction.
  bool receives() const { return reception_.has_value(); }
  uint64_t bytes_a_sample() const { return Waypoints::bytes_a_sample(depth_); }

  // Room for batches of so many samples.
  void reserve(uint64_t samples) { waypoints_.reserve(samples); }
  void begin_frame(uint32_t frame, const RadioEnds& ends, const WorldState& world);
  // Forgets paths and waypoints: the launch begins, or begins again.
  void begin_launch();
  // Labelled rays of these parts follow, and none of an earlier call; also where the batch before is traced again.
  void begin_batch(std::vector<LaunchPart> parts);
  // Rays that have lived through `depth` interactions, and their hits. answered: where a cache was asked.
  void operator()(const RayQueue& rays, const HitList& hits, uint32_t depth, const AnsweredRays* answered = nullptr);
  // The first receiver that each ray passes, for a cache; needs receives().
  void first_receivers(const RayQueue& rays, const HitList& hits, gpu::Buffer<uint32_t>& first);
  void end_batch();

  // Of the launch so far.
  PathGeometry paths() const;
  uint64_t receptions() const { return reception_ ? reception_->count() : 0; }
  WaypointRows take_waypoints() { return std::move(rows_); }

 private:
  glm::dvec3 on_surface(const glm::dvec3& position_m, const SurfacePlace& place) const;
  void keep_waypoints(std::vector<wt_reception> receptions);
  void add(const LaunchPart& part, uint32_t sample, std::span<const wt_waypoint> row,
           std::span<const wt_reception> hits);

  uint64_t wanted_;  // samples a transmitter
  uint32_t depth_;
  SurfaceTable surfaces_;
  Waypoints waypoints_;
  std::optional<SphereReception> reception_;
  uint32_t frame_ = 0;
  RadioEnds ends_;
  WorldState world_;
  std::vector<LaunchPart> parts_;
  WaypointRows rows_;
};

}  // namespace wavetracer
