// SPDX-License-Identifier: Apache-2.0
// Finds edges of the welded mesh, and the planar surfaces that its triangles form.
// Scene::vertices and Scene::triangles must be final: welded, without degenerate or duplicate triangles.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/flatten.hpp"
#include "scene/plane_fit.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Corners may be this far from the plane of their surface without being moved onto it (host/scene/flatten.hpp): for
// paths, a point within 0.1 mm of a plane lies on it.
constexpr double flat_as_it_is_m = 1e-4;
// Normals within a surface that was not moved may differ by 0.45 mrad (1 - cos), which keeps finely divided curves from
// being merged.
constexpr double normal_tolerance = 1e-7;
// A triangle lower than this is judged by its corners only: its normal is rounding noise (0.1 mm of a float32 file are
// 5 mrad of 20 mm), and a strip lower than half a wavelength mirrors nothing by itself.
constexpr double sliver_height_m = 0.02;

// Surfaces whose normals differ by less are in one plane: normals of double vertices have this error, and points of
// reflection are decided to 1e-9 of a path's length.
constexpr double same_plane_rad = 1e-9;
// Tells whether two surfaces lie in one plane, with normals of either sense. on_edge: a point of an edge of both, at
// which this is judged.
bool same_plane(const Surface& a, const Surface& b, const glm::dvec3& on_edge);

// The unit normal of a triangle by its winding, and its height over the longest side (metres).
struct TriangleShape {
  glm::dvec3 normal;
  double area_m2, height_m;
};
TriangleShape triangle_shape(const Scene& scene, uint32_t t);
// Returns all triangles, the largest first; equal ones are ordered by place and not by number.
std::vector<uint32_t> largest_first(const Scene& scene, std::span<const TriangleShape> shapes);
// Tells whether all corners of a triangle, or of a surface, are within near_m of the plane.
bool triangle_is_near(const Scene& scene, uint32_t t, const Plane& plane, double near_m);
bool surface_is_near(const Scene& scene, const Surface& surface, const Plane& plane, double near_m);
inline Plane plane_of(const Surface& surface) { return {surface.normal, surface.offset_m}; }
// Tells whether triangle t, with that shape, lies in the plane without being moved.
bool lies_in_plane(const Scene& scene, uint32_t t, const TriangleShape& shape, const Plane& plane);

// Fills edges and edge_faces, sorted by vertex pair, and the counts of free and non-manifold edges.
// Returns the three edges of every triangle, edge k between corners k and k + 1.
std::vector<std::array<uint32_t, 3>> find_edges(Scene& scene);

// Fills surfaces, surface_triangles and triangle_surface. Surfaces are numbered by their lowest triangle. Triangles of
// one plane of `flat` get exactly that plane; the other surfaces grow from their largest triangle.
void find_surfaces(Scene& scene, std::span<const uint32_t> triangle_material,
                   std::span<const std::array<uint32_t, 3>> triangle_edges, const Flattened& flat);

// Renumbers surfaces by their lowest triangle, from triangle_surface; those without triangles are removed. Planes,
// materials and objects are kept; boxes, triangle counts and surface_triangles are computed again.
void list_surfaces(Scene& scene);

// Returns the vertex (index in Scene::vertices) of triangle t that is not on the edge.
uint32_t apex(const Scene& scene, uint32_t t, const Edge& edge);

// Fills Edge::flat.
void find_flat_edges(Scene& scene);

// Returns the body of each triangle. Bodies are numbered from 0 in the order of their first triangles.
std::vector<uint32_t> bodies_of(const Scene& scene);

}  // namespace wavetracer
