// The legs of one path in the world of a frame: lengths, directions, and what turns them.
// Assumes that vertices lie in their surfaces to rounding error and that surface normals have unit length.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "radio/surface_table.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/world.hpp"

namespace wavetracer {

// A place where a path meets a surface.
struct Meeting {
  SurfacePlace place;
  glm::dvec3 normal;  // the world's axes
};

// Made to be filled again, path after path.
class Legs {
 public:
  void fill(const SurfaceTable& surfaces, const WorldState& state, const PathGeometry& geometry, size_t path);

  double length_m() const { return length_m_; }
  // From the transmitter on, unit length, one more than meetings. The first is 0 where a path ends where it starts.
  const std::vector<glm::dvec3>& directions() const { return directions_; }
  const std::vector<Meeting>& meetings() const { return meetings_; }

 private:
  double length_m_ = 0;
  std::vector<glm::dvec3> directions_;
  std::vector<Meeting> meetings_;
};

// The same length to the last bit, by itself.
double path_length_m(const WorldState& state, const PathGeometry& geometry, size_t path);

// The speed at which a path gets shorter, -dL/dt, of the path that these legs were filled with.
double closing_speed_m_s(const Legs& legs, const SurfaceTable& surfaces, const WorldState& state,
                         const PathGeometry& geometry, size_t path);

}  // namespace wavetracer
