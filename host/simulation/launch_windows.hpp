// SPDX-License-Identifier: Apache-2.0
// Launches from antennas far outside of the scene: drones, platforms in the stratosphere, satellites, sites beside it.
// Few of all their directions meet anything, so their rays go through a window: the part of the sphere in which the
// scene and the vehicles appear. If all rays left the world, the frame could not even say that something is missed.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "passes/generate_rays.hpp"
#include "simulation/launch_slopes.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// A box in recentred metres; with lower > upper it is empty.
struct LaunchBounds {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};
  bool empty() const { return !(lower.x <= upper.x); }
  void add(const glm::dvec3& low, const glm::dvec3& high);
};

// The directions x cos(a) r + y sin(a) r + z h with |a| <= half_rad, low <= h <= high and r = sqrt(1 - h^2).
struct LaunchWindow {
  glm::dvec3 x, y, z;  // orthonormal
  double half_rad, low, high;
  double ahead_m;      // distance along x from the antenna to a place before anything in the window
  bool level = false;  // z is up, so heights are those of the launch without a window
  double solid_angle() const { return 2 * half_rad * (high - low); }
};

// The window from p to all of the box, with a small margin. It is not set if the box surrounds p, or fills so much of
// the sphere that a launch in all directions meets it.
std::optional<LaunchWindow> window_to(const LaunchBounds& box, const glm::dvec3& p);

class LaunchWindows {
 public:
  // It keeps a reference to the instances. followed: the rays are followed, so they start at the antenna itself, and
  // each antenna has one launch.
  LaunchWindows(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances, bool followed);

  // Returns the same launchers; those far outside launch through a window to the static scene and the vehicles. If
  // these are in different directions, vehicles get a launch of their own. Adds the windows to the tables. Launchers
  // name their table of heights, if there is one.
  std::vector<Launcher> of(const std::vector<Launcher>& launchers, const WorldState& state, SlopeTables& tables) const;

 private:
  // The vehicles that are present, without the one that carries the launcher.
  LaunchBounds vehicles(const WorldState& state, uint32_t source) const;
  Launcher through(const LaunchWindow& window, Launcher from, SlopeTables& tables) const;

  LaunchBounds scene_;
  std::span<const Instance> instances_;
  std::vector<double> radius_m_;  // radii of models about their origins
  bool followed_;
};

}  // namespace wavetracer
