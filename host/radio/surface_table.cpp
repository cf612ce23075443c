// Which surface a number means.
// The table is flat: worlds have thousands of moving surfaces, and every vertex of every path asks.
#include "radio/surface_table.hpp"

#include <algorithm>

namespace wavetracer {

SurfaceTable::SurfaceTable(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances)
    : scene_(scene), models_(models) {
  const size_t static_count = scene.surfaces.size();
  for (uint32_t i = 0; i < instances.size(); ++i) {
    const uint32_t part = 1 + instances[i].model;
    const size_t first = instances[i].first_surface - static_count, count = this->scene(part).surfaces.size();
    moving_.resize(std::max(moving_.size(), first + count), {0, 0, no_instance});
    for (uint32_t k = 0; k < count; ++k) moving_[first + k] = {part, k, i};
  }
}

}  // namespace wavetracer
