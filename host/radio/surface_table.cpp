// Which surface a number means, and how it stands and moves in a frame.
// The table is flat: worlds have thousands of moving surfaces, and every vertex of every path asks.
#include "radio/surface_table.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

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

glm::dvec3 SurfaceTable::velocity_m_s(const SurfacePlace& place, const glm::dvec3& position_m,
                                      const WorldState& state) const {
  if (place.instance == no_instance) return glm::dvec3{0};
  const Placement& placement = state.instances[place.instance];
  return placement.velocity_m_s + glm::cross(placement.angular_velocity_rad_s, position_m - placement.position_m);
}

}  // namespace wavetracer
