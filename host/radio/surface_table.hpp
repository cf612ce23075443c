// SPDX-License-Identifier: Apache-2.0
// Surfaces by their numbers in the world, and their places at an instant.
#pragma once
#include <glm/geometric.hpp>

#include "radio/world_numbers.hpp"

namespace wavetracer {

// Keeps references to the scene and the models.
class SurfaceTable : public WorldNumbers {
 public:
  SurfaceTable(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances)
      : WorldNumbers(scene, models, instances, &Scene::surfaces) {}

  const Surface& surface(const WorldPlace& place) const { return scene(place.part).surfaces[place.index]; }

  // The normal in the world's axes.
  glm::dvec3 normal(const WorldPlace& place, const WorldState& state) const {
    const glm::dvec3& normal = surface(place).normal;
    return place.instance == no_instance ? normal : state.instances[place.instance].rotation * normal;
  }
  // Signed distance of a point of the world from the surface's plane.
  double above(const WorldPlace& place, const WorldState& state, const glm::dvec3& p) const {
    const Surface& s = surface(place);
    if (place.instance == no_instance) return glm::dot(s.normal, p) - s.offset_m;
    const Placement& body = state.instances[place.instance];
    return glm::dot(body.rotation * s.normal, p - body.position_m) - s.offset_m;
  }
};

}  // namespace wavetracer
