// Wedges by their numbers in the world, and how they lie at an instant.
#pragma once
#include "radio/utd.hpp"
#include "radio/world_numbers.hpp"

namespace wavetracer {

// Keeps references to the scene, the models and the instances.
class WedgeTable : public WorldNumbers {
 public:
  WedgeTable(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances)
      : WorldNumbers(scene, models, instances, &Scene::wedges), instances_(instances) {}

  const Wedge& wedge(const WorldPlace& place) const { return scene(place.part).wedges[place.index]; }
  // In the world's axes.
  WedgeFrame frame(const WorldPlace& place, const WorldState& state) const {
    const Wedge& w = wedge(place);
    if (place.instance == no_instance) return {w.along, w.face, w.normal, w.exterior_rad};
    const glm::dmat3& turn = state.instances[place.instance].rotation;
    return {turn * w.along, turn * w.face, turn * w.normal, w.exterior_rad};
  }
  // The surface of face 0 or 1, numbered through the world.
  uint32_t face_surface(const WorldPlace& place, int face) const {
    return wedge(place).surface[face] + (place.instance == no_instance ? 0 : instances_[place.instance].first_surface);
  }

 private:
  std::span<const Instance> instances_;
};

}  // namespace wavetracer
