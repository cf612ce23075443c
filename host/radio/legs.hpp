// The legs of one path in the world of a frame: lengths, directions, and what turns them.
// Assumes that vertices lie in their surfaces to rounding error and that surface normals have unit length.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "radio/surface_table.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Made to be filled again, path after path.
class Legs {
 public:
  // surfaces: of reflections, where a leg has no length.
  void fill(const SurfaceTable& surfaces, const WorldState& state, const PathGeometry& geometry, size_t path);

  double length_m() const { return length_m_; }
  // From the transmitter on, one more than interactions; directions of unit length. The first is 0 where a path ends
  // where it starts: paths of near ends are left out before (radio/near_ends.hpp).
  const std::vector<glm::dvec3>& directions() const { return directions_; }
  const std::vector<double>& lengths_m() const { return lengths_m_; }

 private:
  double length_m_ = 0;
  std::vector<glm::dvec3> directions_;
  std::vector<double> lengths_m_;
};

// The same length to the last bit, by itself.
double path_length_m(const WorldState& state, const PathGeometry& geometry, size_t path);

// The speed at which a path gets shorter, -dL/dt, of the path that these legs were filled with. instances: of each
// interaction that one on which it happens, or no_instance.
double closing_speed_m_s(const Legs& legs, const WorldState& state, const PathGeometry& geometry, size_t path,
                         std::span<const uint32_t> instances);

}  // namespace wavetracer
