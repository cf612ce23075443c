// SPDX-License-Identifier: Apache-2.0
#include "gradient/path_gaps.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "gradient/moved_vertices.hpp"
#include "wavetracer/device/path_edges.h"
#include "wavetracer/device/utd.h"

namespace wavetracer {
namespace {

// Directions exactly along z have no azimuth.
bool is_pole(const glm::dvec3& direction) { return direction.x * direction.x + direction.y * direction.y == 0; }

glm::dvec3 in_own_axes(const device::wt_field_end& end, const glm::dvec3& direction) {
  glm::dvec3 out{0};
  for (int axis = 0; axis < 3; ++axis)
    out[axis] =
        end.rotation[axis] * direction.x + end.rotation[3 + axis] * direction.y + end.rotation[6 + axis] * direction.z;
  return out;
}

// The directions from the transmitter and from the receiver into the path.
std::pair<glm::dvec3, glm::dvec3> end_directions(const device::wt_field_world& world, const device::wt_path& path) {
  device::wt_walk_leg leg = device::wt_first_leg(&path);
  const glm::dvec3 departure = leg.direction;
  for (uint32_t k = 0; k < path.depth; ++k) leg = device::wt_next_leg(&world, &path, k, &leg);
  return {departure, -leg.direction};
}

bool meets_cell(const device::wt_field_world& world, const device::wt_path& path) {
  for (uint32_t k = 0; k < path.depth; ++k)
    if (device::wt_is_cell(&world, device::wt_step(&path, k))) return true;
  return false;
}

bool scatters_at_pole(const device::wt_field_world& world, const device::wt_path& path) {
  if (!meets_cell(world, path)) return false;
  device::wt_walk_leg leg = device::wt_first_leg(&path);
  for (uint32_t k = 0; k < path.depth; ++k) {
    const device::wt_walk_leg next = device::wt_next_leg(&world, &path, k, &leg);
    if (device::wt_is_cell(&world, device::wt_step(&path, k)) && (is_pole(leg.direction) || is_pole(next.direction)))
      return true;
    leg = next;
  }
  return false;
}

// Does a leg from or to an edge, which has this azimuth there, run along a face of the edge, and will it not if an end
// of the path moves? next: the edge at the other end of the leg, or null at an end of the path. A leg to an edge that
// lies in the plane of the face stays there.
bool leaves_face(const device::wt_edge& edge, double azimuth, const device::wt_edge* next) {
  if (!device::wt_grazes(azimuth, edge.frame.exterior)) return false;
  const glm::dvec3 normal = device::wt_face_normal(&edge.frame, azimuth < WT_GRAZING_RAD ? 0 : 1);
  return !next || std::abs(glm::dot(normal, next->frame.along)) > 1e-9;
}

bool leaves_any_face(const device::wt_field_world& world, const device::wt_path& path) {
  if (diffractions_of(path) == 0) return false;
  device::wt_edge edges[WT_EDGE_ROOM];
  const uint32_t count = device::wt_edges_of(&world, &path, edges);
  for (uint32_t i = 0; i < count; ++i) {
    const device::wt_turn turn = device::wt_turn_at(&edges[i].frame, edges[i].k_in, edges[i].k_out);
    if (leaves_face(edges[i], turn.in, i > 0 ? edges + i - 1 : nullptr) ||
        leaves_face(edges[i], turn.away, i + 1 < count ? edges + i + 1 : nullptr))
      return true;
  }
  return false;
}

// departure, arrival: see end_directions.
GradientGap gap_of_antennas(const device::wt_field_world& world, const device::wt_path& path,
                            const glm::dvec3& departure, const glm::dvec3& arrival) {
  const bool found = is_pole(in_own_axes(world.transmitters[path.transmitter], departure)) ||
                     is_pole(in_own_axes(world.receivers[path.receiver], arrival));
  return found ? GradientGap::pole : GradientGap::none;
}

}  // namespace

GradientGap gap_of_turns(const device::wt_field_world& world, const device::wt_path& path) {
  const auto [departure, arrival] = end_directions(world, path);
  return gap_of_antennas(world, path, departure, arrival);
}

GradientGap gap_of_positions(const device::wt_field_world& world, const device::wt_path& path) {
  const auto [departure, arrival] = end_directions(world, path);
  if (is_pole(departure) || is_pole(arrival) || scatters_at_pole(world, path)) return GradientGap::pole;
  return leaves_any_face(world, path) ? GradientGap::singular : gap_of_antennas(world, path, departure, arrival);
}

}  // namespace wavetracer
