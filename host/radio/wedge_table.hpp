// Which wedge a number means: the static scene's come first, then those of each instance, in the order of its model.
// Assumes that instances number their wedges without overlap, from Instance::first_wedge on.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "radio/utd.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// A wedge of the world, as its scene has it.
struct WedgePlace {
  uint32_t part;      // which scene: 0 the static one, 1 + m model m
  uint32_t wedge;     // its number there
  uint32_t instance;  // no_instance: static
};

// Keeps references to the scene, the models and the instances.
class WedgeTable {
 public:
  WedgeTable(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances)
      : scene_(scene), models_(models), instances_(instances) {
    for (uint32_t i = 0; i < instances.size(); ++i)
      for (uint32_t k = 0; k < models[instances[i].model].wedges.size(); ++k)
        moving_.push_back({1 + instances[i].model, k, i});
  }

  // id: a number in the world. Throws std::out_of_range for one that no wedge has.
  WedgePlace at(uint32_t id) const {
    const size_t static_count = scene_.wedges.size();
    return id < static_count ? WedgePlace{0, id, no_instance} : moving_.at(id - static_count);
  }
  const Wedge& wedge(const WedgePlace& place) const {
    return (place.part == 0 ? scene_ : models_[place.part - 1]).wedges[place.wedge];
  }
  // In the world's axes.
  WedgeFrame frame(const WedgePlace& place, const WorldState& state) const {
    const Wedge& w = wedge(place);
    if (place.instance == no_instance) return {w.along, w.face, w.normal, w.exterior_rad};
    const glm::dmat3& turn = state.instances[place.instance].rotation;
    return {turn * w.along, turn * w.face, turn * w.normal, w.exterior_rad};
  }
  // The surface of face 0 or 1, numbered through the world.
  uint32_t face_surface(const WedgePlace& place, int face) const {
    return wedge(place).surface[face] + (place.instance == no_instance ? 0 : instances_[place.instance].first_surface);
  }

 private:
  const Scene& scene_;
  std::span<const Scene> models_;
  std::span<const Instance> instances_;
  std::vector<WedgePlace> moving_;  // of the numbers from the static scene's on
};

}  // namespace wavetracer
