// SPDX-License-Identifier: Apache-2.0
// The way and the turn of a vehicle since its track began, as things that roll with it count them.
#pragma once
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "motion/pose.hpp"
#include "motion/trajectories.hpp"

namespace wavetracer {

// The time integrals of the velocity and of the angular velocity along the vehicle's own axes (ahead, left, up), and
// these velocities. A place c of the vehicle goes way_m + cross(turn_rad, c) along them.
struct Travelled {
  glm::dvec3 way_m{0}, turn_rad{0};
  glm::dvec3 velocity_m_s{0}, rate_rad_s{0};
};

// The velocities of a pose, with integrals of zero.
Travelled velocities_of(const Pose& pose);

// Adds to the integrals what a vehicle with these poses goes between two times; without a pose it stands still. The
// poses are smooth there.
void add_way(Travelled& sum, const std::function<std::optional<Pose>(double)>& pose, double from_s, double to_s);

// The integrals of one track. They stand still while the vehicle is absent. Keeps nothing of the track.
class Travel {
 public:
  explicit Travel(const Track& track);
  // track: that of the constructor. Before its first sample and after its last one they are those of that sample,
  // with velocities of zero where the vehicle is absent.
  Travelled at(const Track& track, double time_s) const;

 private:
  std::vector<Travelled> at_samples_;
};

}  // namespace wavetracer
