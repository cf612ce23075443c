// SPDX-License-Identifier: Apache-2.0
// Records of rays besides their sequences: the receivers that they pass (trace.reception = "sphere"), and the waypoints
// of some of them (output.waypoints).
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "passes/waypoints.hpp"
#include "radio/surface_table.hpp"
#include "simulation/ray_follower.hpp"
#include "simulation/sphere_reception.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/ray_waypoints.hpp"

namespace wavetracer {

class RayTrails final : public RayFollower {
 public:
  // depth: the most interactions of a ray. The scenes that `surfaces` refers to must outlive this.
  RayTrails(gpu::Context& context, const TraceConfig& trace, uint64_t samples_a_transmitter, uint32_t depth,
            const SurfaceTable& surfaces);
  // Are receptions recorded? Then rays need a segment after their last interaction.
  bool receives() const { return reception_.has_value(); }
  // Begins the frame, with its ends and the places of its vehicles.
  void begin_frame(uint32_t frame, const RadioEnds& ends, const WorldState& world);

  uint32_t extra_segments() const override { return receives(); }
  uint64_t bytes_per_sample() const override { return Waypoints::bytes_a_sample(depth_); }
  void reserve(uint64_t samples) override { waypoints_.reserve(samples); }
  void begin_launch() override;
  void begin_batch(std::vector<LaunchPart> parts) override;
  void follow(const RayQueue& rays, const HitList& hits, uint32_t depth,
              const std::optional<AnsweredRays>& answered) override;
  void end_batch() override;
  // Finds the first receiver that each ray passes, for a cache; needs receives().
  void first_receivers(const RayQueue& rays, const HitList& hits, gpu::Buffer<uint32_t>& first);

  // The paths of the launch so far.
  PathGeometry paths() const;
  uint64_t receptions() const { return reception_ ? reception_->count() : 0; }
  WaypointRows take_waypoints() { return std::move(rows_); }

 private:
  glm::dvec3 on_surface(const glm::dvec3& position_m, const WorldPlace& place) const;
  void keep_waypoints(std::vector<wt_reception> receptions);
  // The source of the segment that ends there.
  WaypointSource source_of(const wt_waypoint& end) const;
  void add(const LaunchPart& part, uint32_t sample, std::span<const wt_waypoint> row,
           std::span<const wt_reception> hits);

  uint64_t wanted_;  // samples per transmitter
  uint32_t depth_;
  SurfaceTable surfaces_;
  Waypoints waypoints_;
  std::optional<SphereReception> reception_;
  uint32_t frame_ = 0;
  bool vehicles_cached_ = false;
  RadioEnds ends_;
  WorldState world_;
  std::vector<LaunchPart> parts_;
  WaypointRows rows_;
};

}  // namespace wavetracer
