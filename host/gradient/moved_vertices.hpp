// SPDX-License-Identifier: Apache-2.0
// The vertices of a path as functions of its ends. Reflections and transmissions are where the image method puts them;
// edges are where the way is the shortest one (the implicit function theorem); scattering points stay.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "tangent/path_world.h"
#include "wavetracer/device/path_world.h"
#include "wavetracer/device/records.h"

namespace wavetracer {

// A vertex that the image method or the shortest way puts farther than this from where it is was not solved.
constexpr double most_vertex_error_m = 1e-5;

// The number of edges that the path bends at.
uint32_t diffractions_of(const device::wt_path& path);

// Lanes are the coordinates of the transmitter, then those of the receiver; values are those of the path. An object
// keeps its memory from path to path.
class MovedVertices {
 public:
  void set(const device::wt_field_world& world, const device::wt_path& path);

  tangent::wt_double3 from, to;
  std::vector<tangent::wt_double3> vertices;
  bool solved = true;  // false: the vertices are not those of a solved path, and derivatives are not set

 private:
  enum class Motion { end, along_edge, none };
  // A point of the path between which the others follow by the image method: an end, an edge or a scattering point.
  struct Anchor {
    uint32_t vertex = 0;  // the number of its vertex; for the transmitter one before the first, see begin_after
    Motion motion = Motion::none;
    glm::dvec3 point{0}, along{0};  // along: the unit vector of an edge
    size_t variable = 0;            // the first of its variables: one of an edge, three of an end
    size_t variables() const { return motion == Motion::end ? 3 : motion == Motion::along_edge ? 1 : 0; }
    // Its velocity as the i-th of its variables grows.
    glm::dvec3 velocity(size_t i) const;
  };
  // Derivatives of the place along each edge by the six coordinates of the ends.
  using EdgeRates = std::array<std::array<double, 6>, WT_MOST_EDGES>;
  // First and second derivatives of the path's length by the places along the edges, which come first, and the
  // coordinates of the ends; there are no rows for these.
  struct LengthForm {
    std::array<double, WT_MOST_EDGES> slope{};
    std::array<std::array<double, WT_MOST_EDGES + 6>, WT_MOST_EDGES> rows{};
  };

  void find_anchors(const device::wt_field_world& world, const device::wt_path& path);
  uint32_t begin_after(size_t i) const { return i == 0 ? 0 : anchors_[i].vertex + 1; }
  LengthForm length_form(const device::wt_field_world& world, const device::wt_path& path) const;
  // *error_m: how far the places are from those of the shortest way.
  EdgeRates edge_rates(LengthForm form, double* error_m) const;
  tangent::wt_double3 moved_point(const Anchor& anchor, const EdgeRates& rates) const;
  // Puts the vertices from `begin` to end - 1 between two points by the image method. Returns how far they are from
  // those of the path.
  double place_between(const device::wt_field_world& world, const device::wt_path& path, uint32_t begin, uint32_t end,
                       const tangent::wt_double3& first, const tangent::wt_double3& last);

  std::vector<Anchor> anchors_;
  size_t edges_ = 0;                         // the number of anchors that move along edges
  std::vector<tangent::wt_double3> images_;  // the images of the point before a stretch at its planes
};

}  // namespace wavetracer
