// SPDX-License-Identifier: Apache-2.0
// The surface or wedge that a number of the world means: those of the static scene come first, then those of each
// instance, in the order of its model (Instance::first_surface, first_wedge). The table is flat: worlds have thousands
// of moving surfaces, and it is read for every vertex of every path.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct WorldPlace {
  uint32_t part;      // the scene: 0 is the static one, 1 + m is model m
  uint32_t index;     // its number there
  uint32_t instance;  // no_instance: static
};

// Keeps references to the scene and the models.
class WorldNumbers {
 public:
  // items: the numbered things, &Scene::surfaces or &Scene::wedges.
  template <class Item>
  WorldNumbers(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances,
               std::vector<Item> Scene::*items)
      : scene_(scene), models_(models), static_count_((scene.*items).size()) {
    for (uint32_t i = 0; i < instances.size(); ++i)
      for (uint32_t k = 0; k < (models[instances[i].model].*items).size(); ++k)
        moving_.push_back({1 + instances[i].model, k, i});
  }

  // id: a number in the world. Throws std::out_of_range for a number that does not exist.
  WorldPlace at(uint32_t id) const {
    return id < static_count_ ? WorldPlace{0, id, no_instance} : moving_.at(id - static_count_);
  }
  const Scene& scene(uint32_t part) const { return part == 0 ? scene_ : models_[part - 1]; }
  uint32_t part_count() const { return 1 + static_cast<uint32_t>(models_.size()); }

 private:
  const Scene& scene_;
  std::span<const Scene> models_;
  size_t static_count_;
  std::vector<WorldPlace> moving_;  // places of the numbers from the static scene's on
};

}  // namespace wavetracer
