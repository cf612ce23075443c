// SPDX-License-Identifier: Apache-2.0
// The slow, obvious oracle: every sequence of surfaces and wedges is tried, every leg is tested against every triangle,
// in double. It shares no code with the ray tracer, and is meant for scenes of up to about 60 surfaces and 3
// interactions.
#pragma once
#include <glm/vec3.hpp>
#include <vector>
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::reference {

// The paths that are wanted; line of sight always is.
struct Limits {
  uint32_t max_depth = 3;  // interactions a path, transmissions included
  bool reflection = true;
  bool transmission = false;
  uint32_t max_transmissions = 2;  // a path
  bool diffraction = false;
  uint32_t max_diffractions = 1;            // a path, 1 or 2; two follow each other, with no reflection between them
  bool free_edges = true;                   // wedges of one face diffract
  double wavelength_m = 299792458 / 5.9e9;  // corners diffract unless that is too weak (wedge_points.hpp)
};

// All paths of reflections, transmissions and diffractions at Scene::wedges within the limits, by the image method and
// Fermat's principle. Positions and vertices are recentred, as the scene is; numbers are those of PathGeometry. Rows
// are sorted by tx, rx, number of interactions, then their kinds, then their surfaces and wedges.
//
// Rules for a path:
// - a receiver at a transmitter has no line of sight;
// - a sequence never names one surface or wedge twice in a row;
// - each reflection point lies inside its surface, borders included (to 1e-9 of the triangle's size), and both
//   neighbours of the point are on the same side of the surface's plane;
// - reflections in one point, where surfaces meet in a corner, are a path if each of these surfaces goes on in front of
//   the others there: no wave beside the corner of a house meets both of its walls;
// - each diffraction point lies on its edge, ends included, and both neighbours of it are in the wedge's sector of free
//   space, faces included (to 1e-9 rad), and off the edge's line by more than 1e-4 m;
// - no leg that begins or ends at a wedge is shorter than 1e-4 m;
// - no leg is blocked. A surface blocks a leg when the leg crosses one of its triangles, both ends of the leg lie on
//   opposite sides of its plane, and the leg neither starts nor ends on that surface (reference/planes.hpp has the
//   rule for what touches). With transmission such a surface is passed instead, and is an interaction of the path;
//   crossings within 1e-4 m of parallel planes are one, of the first surface;
// - of paths of one transmitter, receiver and kind whose vertices agree within 1e-4 m, the first is kept: a point on
//   the border of two coplanar surfaces is one path.
// Positions should be generic: whether a leg passes an edge exactly on it is left to rounding.
PathGeometry brute_force_all(const Scene& scene, const std::vector<glm::dvec3>& transmitters,
                             const std::vector<glm::dvec3>& receivers, const Limits& limits);

// The same with at most max_order reflections and nothing else.
PathGeometry brute_force_paths(const Scene& scene, const std::vector<glm::dvec3>& transmitters,
                               const std::vector<glm::dvec3>& receivers, uint32_t max_order);

// The length of path i, legs added up from the transmitter on.
double path_length_m(const PathGeometry& paths, size_t i, const glm::dvec3& transmitter, const glm::dvec3& receiver);

}  // namespace wavetracer::reference
