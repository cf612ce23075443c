// Launches from antennas far outside of the scene: drones, platforms in the stratosphere, satellites, sites beside it.
// Few of all their directions meet anything, so their rays go through a window: the part of the sphere in which the
// scene and the vehicles appear. Rays that all leave the world would tell nothing, not even that something is missed.
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

// Directions x cos(a) r + y sin(a) r + z h with |a| <= half_rad, low <= h <= high and r = sqrt(1 - h^2).
struct LaunchWindow {
  glm::dvec3 x, y, z;  // orthonormal
  double half_rad, low, high;
  double ahead_m;      // along x from the antenna, before anything in the window
  bool level = false;  // z is up, so that heights are those of the launch without a window
  double solid_angle() const { return 2 * half_rad * (high - low); }
};

// The window from p to all of the box, with a little to spare. Not set if the box fills so much of the sphere, or
// surrounds p, that a launch in all directions meets it.
std::optional<LaunchWindow> window_to(const LaunchBounds& box, const glm::dvec3& p);

class LaunchWindows {
 public:
  // Keeps a reference to the instances. followed: somebody follows the rays, so that they start at the antenna itself,
  // and each antenna has one launch.
  LaunchWindows(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances, bool followed);

  // The same launchers, those far outside through a window to the static scene and the vehicles; where these are
  // elsewhere, they get a launch of their own. Adds the windows to the tables. Launchers name their table of heights,
  // if there are any.
  std::vector<Launcher> of(const std::vector<Launcher>& launchers, const WorldState& state, SlopeTables& tables) const;

 private:
  // The vehicles that are there, without the one that carries the launcher.
  LaunchBounds vehicles(const WorldState& state, uint32_t source) const;
  Launcher through(const LaunchWindow& window, Launcher from, SlopeTables& tables) const;

  LaunchBounds scene_;
  std::span<const Instance> instances_;
  std::vector<double> radius_m_;  // of models about their origins
  bool followed_;
};

}  // namespace wavetracer
