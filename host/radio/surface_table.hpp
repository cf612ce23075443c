// Which surface a number means: the static scene's come first, then those of each instance, in the order of its model.
// Assumes that instances number their surfaces without overlap, from Instance::first_surface on.
#pragma once
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// A surface of the world, as its scene has it.
struct SurfacePlace {
  uint32_t part;      // which scene: 0 the static one, 1 + m model m
  uint32_t surface;   // its number there
  uint32_t instance;  // no_instance: static
};

// Keeps references to the scene and the models.
class SurfaceTable {
 public:
  SurfaceTable(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances);

  // id: a number in the world. Throws std::out_of_range for one that no surface has.
  SurfacePlace at(uint32_t id) const {
    const size_t static_count = scene_.surfaces.size();
    return id < static_count ? SurfacePlace{0, id, no_instance} : moving_.at(id - static_count);
  }
  const Scene& scene(uint32_t part) const { return part == 0 ? scene_ : models_[part - 1]; }
  uint32_t part_count() const { return 1 + static_cast<uint32_t>(models_.size()); }
  const Surface& surface(const SurfacePlace& place) const { return scene(place.part).surfaces[place.surface]; }

  // In the world's axes.
  glm::dvec3 normal(const SurfacePlace& place, const WorldState& state) const {
    const glm::dvec3& normal = surface(place).normal;
    return place.instance == no_instance ? normal : state.instances[place.instance].rotation * normal;
  }
  // Signed distance of a point of the world from the surface's plane.
  double above(const SurfacePlace& place, const WorldState& state, const glm::dvec3& p) const {
    const Surface& s = surface(place);
    if (place.instance == no_instance) return glm::dot(s.normal, p) - s.offset_m;
    const Placement& body = state.instances[place.instance];
    return glm::dot(body.rotation * s.normal, p - body.position_m) - s.offset_m;
  }

 private:
  const Scene& scene_;
  std::span<const Scene> models_;
  std::vector<SurfacePlace> moving_;  // of the numbers from the static scene's on
};

}  // namespace wavetracer
