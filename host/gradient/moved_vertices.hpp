// SPDX-License-Identifier: Apache-2.0
// The vertices of a path as functions of its ends. Reflections and transmissions are where the image method puts them;
// edges are where the way is the shortest one (the implicit function theorem); scattering points stay.
#pragma once
#include <vector>

#include "tangent/path_world.h"
#include "wavetracer/device/path_world.h"

namespace wavetracer {

// A vertex that the image method or the shortest way puts farther than this from where it is was not solved.
constexpr double most_vertex_error_m = 1e-5;

// Lanes are the coordinates of the transmitter, then those of the receiver; values are those of the path.
struct MovedVertices {
  tangent::wt_double3 from, to;
  std::vector<tangent::wt_double3> vertices;
  bool solved = true;  // false: the vertices are not those of a solved path, and derivatives are not set
};
MovedVertices moved_vertices(const device::wt_field_world& world, const device::wt_path& path);

}  // namespace wavetracer
