// SPDX-License-Identifier: Apache-2.0
// Meshes for the tests of surfaces and wedges, and a check of wedges by distances to all triangles.
// The check knows nothing of edges: around a wedge there must be its two faces and nothing else.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "scene/build_scene.hpp"

namespace wavetracer::test {

using glm::dvec3;
constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

inline RawMesh mesh(std::vector<dvec3> vertices, std::vector<Triangle> triangles) {
  return {"mesh", "test", std::move(vertices), std::move(triangles), 0};
}

inline RawMesh quad(dvec3 corner, dvec3 u, dvec3 v) {
  return mesh({corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}});
}

inline RawMesh box(dvec3 low, dvec3 high, bool with_bottom = true) {
  RawMesh out;
  for (unsigned i = 0; i < 8; ++i)
    out.vertices.emplace_back((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z);
  for (const auto& [a, b, c, d] : {std::array{4u, 5u, 7u, 6u},
                                   {0u, 1u, 5u, 4u},
                                   {2u, 6u, 7u, 3u},
                                   {0u, 4u, 6u, 2u},
                                   {1u, 3u, 7u, 5u},
                                   {0u, 2u, 3u, 1u}}) {
    if (!with_bottom && a == 0u && b == 2u) continue;
    out.triangles.push_back({a, b, c});
    out.triangles.push_back({a, c, d});
  }
  return out;
}

// An L of six corners, 4 x 4 m with a notch of 2 x 2 m, 3 m high, closed.
inline RawMesh l_building() {
  const std::vector<std::array<double, 2>> outline{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  RawMesh out;
  for (const double z : {0.0, 3.0}) {
    for (const auto& [x, y] : outline) out.vertices.emplace_back(x, y, z);
  }
  for (const Triangle t : {Triangle{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    out.triangles.push_back({t[2], t[1], t[0]});
    out.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (uint32_t i = 0; i < 6; ++i) {
    const uint32_t j = (i + 1) % 6;
    out.triangles.push_back({i, j, j + 6});
    out.triangles.push_back({i, j + 6, i + 6});
  }
  return out;
}

// Builds a scene of meshes, whose materials are given by index, one for each mesh; vertices within the tolerance of a
// plane are moved onto it.
inline Scene build(std::vector<RawMesh> meshes, std::vector<uint32_t> material = {}, double tolerance_m = 0) {
  RawScene raw;
  raw.file = "test";
  raw.meshes = std::move(meshes);
  ResolvedMaterials resolved;
  resolved.materials = {find_itu_law("P.2040-4", "concrete", 5.9)->material,
                        find_itu_law("P.2040-4", "brick", 5.9)->material};
  material.resize(raw.meshes.size(), 0);
  resolved.mesh_material = std::move(material);
  return build_scene(raw, std::move(resolved), EdgeSearch::of_model, tolerance_m);
}

inline dvec3 end_of(const Wedge& w) { return w.start + w.along * w.length_m; }
inline bool is_free(const Wedge& w) { return w.surface[0] == w.surface[1]; }
inline size_t free_count(const Scene& s) {
  return static_cast<size_t>(std::count_if(s.wedges.begin(), s.wedges.end(), is_free));
}

// Returns the wedge between two points of the file, in either direction; nullptr if there is none or more than one.
// exterior_deg: the exterior angle it must have, if not 0.
inline const Wedge* between(const Scene& s, const dvec3& a, const dvec3& b, double within_m = 1e-9,
                            double exterior_deg = 0) {
  const Wedge* found = nullptr;
  int count = 0;
  for (const Wedge& w : s.wedges) {
    if (exterior_deg != 0 && std::abs(w.exterior_rad - exterior_deg * degree) >= 1e-12) continue;
    const dvec3 p = s.origin_m + w.start, q = s.origin_m + end_of(w);
    const double apart_m = std::min(std::max(glm::distance(p, a), glm::distance(q, b)),
                                    std::max(glm::distance(p, b), glm::distance(q, a)));
    if (apart_m > within_m) continue;
    found = &w;
    ++count;
  }
  return count == 1 ? found : nullptr;
}

inline bool diffracts(const Scene& s, const dvec3& a, const dvec3& b, double exterior_deg) {
  return between(s, a, b, 1e-9, exterior_deg) != nullptr;
}

// Returns the distance to a triangle: to its inside or its nearest side.
inline double distance_m(const dvec3& p, const std::array<dvec3, 3>& t) {
  const dvec3 n = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < 3; ++k) {
    const dvec3 a = t[k], way = t[(k + 1) % 3] - a;
    inside &= glm::dot(glm::cross(way, p - a), n) >= 0;
    const double along = std::clamp(glm::dot(p - a, way) / glm::dot(way, way), 0.0, 1.0);
    nearest = std::min(nearest, glm::distance(p, a + way * along));
  }
  return inside ? std::abs(glm::dot(p - t[0], n)) : nearest;
}

inline double distance_m(const Scene& s, const dvec3& p, uint32_t surface = 0xFFFFFFFFu) {
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t t = 0; t < s.triangles.size(); ++t) {
    if (surface != 0xFFFFFFFFu && s.triangle_surface[t] != surface) continue;
    const auto& [a, b, c] = s.triangles[t];
    nearest = std::min(nearest, distance_m(p, {s.vertices[a], s.vertices[b], s.vertices[c]}));
  }
  return nearest;
}

// Checks the contract of Wedge by the distances of points around it from all triangles.
inline void check_contract(const Scene& s, double touching_m = 1e-9) {
  for (const Wedge& w : s.wedges) {
    CAPTURE(w.start.x);
    CAPTURE(w.start.y);
    CAPTURE(w.start.z);
    CHECK(w.length_m > 0);
    CHECK(glm::length(w.along) == doctest::Approx(1).epsilon(1e-14));
    CHECK(glm::length(w.face) == doctest::Approx(1).epsilon(1e-14));
    CHECK(std::abs(glm::dot(w.along, w.face)) < 1e-14);
    CHECK(glm::distance(glm::cross(w.face, w.normal), w.along) < 1e-14);
    CHECK(w.exterior_rad > 1e-3);
    CHECK(std::abs(w.exterior_rad - pi) > 1e-9);
    CHECK(std::abs(w.exterior_rad - pi / 2) > 3e-6);
    CHECK(w.exterior_rad <= 2 * pi);
    CHECK(is_free(w) == (w.exterior_rad == 2 * pi));
    const double radius_m = 0.01;
    const dvec3 on_edge = w.start + w.along * (w.length_m * 0.37);  // no other face crosses the edge there
    const auto at = [&](double azimuth) {
      return on_edge + (w.face * std::cos(azimuth) + w.normal * std::sin(azimuth)) * radius_m;
    };
    CHECK(distance_m(s, at(0), w.surface[0]) <= touching_m);
    CHECK(distance_m(s, at(w.exterior_rad), w.surface[1]) <= touching_m);
    for (int i = 1; i < 64; ++i) {
      const double azimuth = w.exterior_rad * i / 64;
      const double to_face = std::min({azimuth, w.exterior_rad - azimuth, pi / 2});
      CHECK(distance_m(s, at(azimuth)) >= radius_m * std::sin(to_face) - touching_m - 1e-12);
    }
  }
}

inline double total_length_m(const Scene& s) {
  double sum = 0;
  for (const Wedge& w : s.wedges) sum += w.length_m;
  return sum;
}

}  // namespace wavetracer::test
