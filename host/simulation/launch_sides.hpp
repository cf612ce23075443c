// SPDX-License-Identifier: Apache-2.0
// Launches from antennas on surfaces. In float32 the start of a ray may be behind a surface that the antenna stands on,
// or just in front of it; paths are decided in double, where a surface closer than 0.1 mm does not hide an antenna
// (kernels/lib/legs.clh). So such an antenna launches from both sides of the surface, a step beside it.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "passes/generate_rays.hpp"
#include "scene/box_grid.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// It keeps references to the models and the instances. Launchers of one call have different transmitters.
class LaunchSides {
 public:
  LaunchSides(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances);

  // Returns the same launchers; those on surfaces appear once for each side of each surface, of at most three surfaces.
  std::vector<Launcher> of(const std::vector<Launcher>& launchers, const WorldState& state);

 private:
  // A plane with its unit normal, and the height of a point above it.
  struct Plane {
    glm::dvec3 normal;
    double above_m;
  };
  // The planes of a scene, by the boxes of their surfaces.
  struct Planes {
    explicit Planes(const Scene& scene);
    const Scene* scene;
    BoxGrid boxes;
    double radius_m;  // that of the scene about its own origin
    // Appends the planes that the point is on.
    void find(const glm::dvec3& p, double tolerance_m, std::vector<Plane>& found) const;
  };
  // For each launcher the planes of the static scene at its place, which mostly does not change from frame to frame.
  struct Known {
    glm::dvec3 position_m;
    std::vector<Plane> planes;
  };
  std::vector<Plane> planes_at(const Launcher& launcher, const WorldState& state, double step_m,
                               std::optional<Known>& known) const;

  std::span<const Instance> instances_;
  Planes static_;
  std::vector<Planes> models_;
  std::vector<std::optional<Known>> known_;
};

}  // namespace wavetracer
