// SPDX-License-Identifier: Apache-2.0
// Finds edges by sorting, surfaces by growing from the largest triangle.
// A surface's plane is that of its seed, or the plane that its vertices were moved onto. It does not change while the
// surface grows, so a chain of small bends cannot drift into a curve.
#include "scene/topology.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

#include "base/forest.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr uint32_t unassigned = 0xFFFFFFFFu;

class SurfaceGrower {
 public:
  SurfaceGrower(const Scene& scene, std::span<const uint32_t> material,
                std::span<const std::array<uint32_t, 3>> triangle_edges, const Flattened& flat)
      : scene_(scene),
        material_(material),
        triangle_edges_(triangle_edges),
        flat_(flat),
        seed_of_(scene.triangles.size(), unassigned),
        in_exact_(scene.triangles.size(), false) {
    shapes_.reserve(scene.triangles.size());
    for (uint32_t t = 0; t < scene.triangles.size(); ++t) shapes_.push_back(triangle_shape(scene, t));
  }

  // Returns the seed of every triangle's surface.
  std::vector<uint32_t> grow() {
    for (const uint32_t seed : largest_first(scene_, shapes_)) {
      if (seed_of_[seed] == unassigned) grow_from(seed);
    }
    return std::move(seed_of_);
  }

  // Returns the plane of a seed.
  Plane plane_of(uint32_t t) const {
    if (flat_.triangle_plane[t] != no_plane) return flat_.planes[flat_.triangle_plane[t]];
    return in_exact_[t] ? flat_.planes[flat_.exact_plane[t]] : own_plane(t);
  }

 private:
  Plane own_plane(uint32_t t) const {
    // A flattened strip has no normal.
    const dvec3 n = shapes_[t].area_m2 > 0 ? oriented(shapes_[t].normal) : dvec3(0, 0, 1);
    return {n, glm::dot(n, scene_.vertices[scene_.triangles[t][0]])};
  }

  // A part of an exact plane gets the plane of its seed if all of it lies in that plane, else the exact one.
  void grow_from(uint32_t seed) {
    const size_t before = grown_.size();
    if (grow(seed, plane_of(seed)) || flat_.exact_plane[seed] == no_plane) return;
    for (size_t i = before; i < grown_.size(); ++i) seed_of_[grown_[i]] = unassigned;
    grown_.resize(before);
    in_exact_[seed] = true;
    grow(seed, plane_of(seed));
  }

  // Returns false if a neighbour of the same material in the seed's exact plane stays outside.
  bool grow(uint32_t seed, const Plane& plane) {
    bool whole = true;
    const size_t first = grown_.size();
    take(seed, seed);
    for (size_t k = first; k < grown_.size(); ++k) {
      for (uint32_t e : triangle_edges_[grown_[k]]) {
        const Edge& edge = scene_.edges[e];
        for (uint32_t i = 0; i < edge.face_count; ++i) {
          const uint32_t other = scene_.edge_faces[edge.first_face + i];
          if (seed_of_[other] != unassigned || material_[other] != material_[seed]) continue;
          if (continues(seed, other, plane))
            take(other, seed);
          else
            whole &= flat_.exact_plane[other] != flat_.exact_plane[seed];
        }
      }
    }
    return whole;
  }
  void take(uint32_t t, uint32_t seed) {
    seed_of_[t] = seed;
    grown_.push_back(t);
  }

  bool continues(uint32_t seed, uint32_t t, const Plane& plane) const {
    if (flat_.triangle_plane[t] != flat_.triangle_plane[seed]) return false;
    if (flat_.triangle_plane[t] != no_plane || (in_exact_[seed] && flat_.exact_plane[t] == flat_.exact_plane[seed]))
      return true;
    return lies_in_plane(scene_, t, shapes_[t], plane);
  }

  const Scene& scene_;
  std::span<const uint32_t> material_;
  std::span<const std::array<uint32_t, 3>> triangle_edges_;
  const Flattened& flat_;
  std::vector<TriangleShape> shapes_;
  std::vector<uint32_t> seed_of_, grown_;
  std::vector<bool> in_exact_;  // per seed: its surface has the exact plane
};

bool is_flat(const Scene& scene, const Edge& edge) {
  const uint32_t* faces = scene.edge_faces.data() + edge.first_face;
  const uint32_t first = scene.triangle_surface[faces[0]];
  const dvec3 a = scene.vertices[edge.vertices[0]];
  const dvec3 along = scene.vertices[edge.vertices[1]] - a;
  const dvec3 side = glm::cross(scene.surfaces[first].normal, along);  // direction in the plane, across the edge
  bool left = false, right = false;
  for (uint32_t i = 0; i < edge.face_count; ++i) {
    const uint32_t surface = scene.triangle_surface[faces[i]];
    if (surface != first && !same_plane(scene.surfaces[first], scene.surfaces[surface], a)) return false;
    const double across = glm::dot(side, scene.vertices[apex(scene, faces[i], edge)] - a);
    left |= across > 0;
    right |= across < 0;
  }
  return left && right;
}

}  // namespace

bool same_plane(const Surface& a, const Surface& b, const dvec3& on_edge) {
  const double sine = glm::length(glm::cross(a.normal, b.normal));
  const double over_a_m = glm::dot(a.normal, on_edge) - a.offset_m, over_b_m = glm::dot(b.normal, on_edge) - b.offset_m;
  const double gap_m = over_a_m - (glm::dot(a.normal, b.normal) < 0 ? -over_b_m : over_b_m);
  return sine <= same_plane_rad && std::abs(gap_m) <= 2 * flat_as_it_is_m;
}

uint32_t apex(const Scene& scene, uint32_t t, const Edge& edge) {
  for (uint32_t v : scene.triangles[t]) {
    if (v != edge.vertices[0] && v != edge.vertices[1]) return v;
  }
  return scene.triangles[t][0];
}

TriangleShape triangle_shape(const Scene& scene, uint32_t t) {
  const auto& [a, b, c] = scene.triangles[t];
  const dvec3 u = scene.vertices[b] - scene.vertices[a], v = scene.vertices[c] - scene.vertices[a];
  const dvec3 n = glm::cross(u, v);
  const double twice_area = glm::length(n);
  const double longest = std::max({glm::length(u), glm::length(v), glm::length(v - u)});
  // It divides, since multiplying by a reciprocal would make the normals of axis-parallel triangles inexact.
  return {twice_area > 0 ? n / twice_area : dvec3(0), twice_area / 2, longest > 0 ? twice_area / longest : 0};
}

std::vector<uint32_t> largest_first(const Scene& scene, std::span<const TriangleShape> shapes) {
  const auto corner_sum = [&](uint32_t t) {
    const auto& [a, b, c] = scene.triangles[t];
    return scene.vertices[a] + scene.vertices[b] + scene.vertices[c];
  };
  std::vector<uint32_t> order(shapes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    if (shapes[a].area_m2 != shapes[b].area_m2) return shapes[a].area_m2 > shapes[b].area_m2;
    const dvec3 p = corner_sum(a), q = corner_sum(b);
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  return order;
}

bool triangle_is_near(const Scene& scene, uint32_t t, const Plane& plane, double near_m) {
  return std::ranges::all_of(scene.triangles[t],
                             [&](uint32_t v) { return std::abs(height_over(plane, scene.vertices[v])) <= near_m; });
}

bool surface_is_near(const Scene& scene, const Surface& surface, const Plane& plane, double near_m) {
  for (uint32_t k = 0; k < surface.triangle_count; ++k)
    if (!triangle_is_near(scene, scene.surface_triangles[surface.first_triangle + k], plane, near_m)) return false;
  return true;
}

bool lies_in_plane(const Scene& scene, uint32_t t, const TriangleShape& shape, const Plane& plane) {
  if (shape.height_m > sliver_height_m && std::abs(glm::dot(shape.normal, plane.normal)) <= 1 - normal_tolerance)
    return false;
  return triangle_is_near(scene, t, plane, flat_as_it_is_m);
}

std::vector<std::array<uint32_t, 3>> find_edges(Scene& scene) {
  struct Side {
    uint64_t key;       // both vertices, the lower one above
    uint64_t position;  // 4 * triangle + corner
  };
  std::vector<Side> sides;
  sides.reserve(scene.triangles.size() * 3);
  for (uint64_t t = 0; t < scene.triangles.size(); ++t) {
    for (uint64_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(scene.triangles[t][k], scene.triangles[t][(k + 1) % 3]);
      sides.push_back({uint64_t{low} << 32 | high, t * 4 + k});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.key != b.key ? a.key < b.key : a.position < b.position; });
  std::vector<std::array<uint32_t, 3>> triangle_edges(scene.triangles.size());
  scene.edges.clear();
  scene.edge_faces.clear();
  scene.edge_faces.reserve(sides.size());
  scene.report.free_edges = scene.report.nonmanifold_edges = 0;
  for (size_t i = 0; i < sides.size(); ++i) {
    if (i == 0 || sides[i].key != sides[i - 1].key) {
      const auto high = static_cast<uint32_t>(sides[i].key >> 32), low = static_cast<uint32_t>(sides[i].key);
      scene.edges.push_back({{high, low}, static_cast<uint32_t>(i), 0, false});
    }
    ++scene.edges.back().face_count;
    const uint64_t t = sides[i].position / 4;
    scene.edge_faces.push_back(static_cast<uint32_t>(t));
    triangle_edges[t][sides[i].position % 4] = static_cast<uint32_t>(scene.edges.size() - 1);
  }
  for (const Edge& edge : scene.edges) {
    scene.report.free_edges += edge.face_count == 1;
    scene.report.nonmanifold_edges += edge.face_count > 2;
  }
  return triangle_edges;
}

void find_surfaces(Scene& scene, std::span<const uint32_t> triangle_material,
                   std::span<const std::array<uint32_t, 3>> triangle_edges, const Flattened& flat) {
  SurfaceGrower grower(scene, triangle_material, triangle_edges, flat);
  const std::vector<uint32_t> seed_of = grower.grow();
  const size_t count = scene.triangles.size();
  scene.surfaces.clear();
  scene.triangle_surface.assign(count, unassigned);
  std::vector<uint32_t> surface_of_seed(count, unassigned);
  for (uint32_t t = 0; t < count; ++t) {
    const uint32_t seed = seed_of[t];
    uint32_t& index = surface_of_seed[seed];
    if (index == unassigned) {
      index = static_cast<uint32_t>(scene.surfaces.size());
      const Plane plane = grower.plane_of(seed);
      scene.surfaces.push_back(
          {plane.normal, plane.offset_m, {}, {}, triangle_material[seed], scene.triangle_object[seed], 0, 0});
    }
    scene.triangle_surface[t] = index;
  }
  list_surfaces(scene);
}

void list_surfaces(Scene& scene) {
  std::vector<Surface> listed;
  std::vector<uint32_t> number(scene.surfaces.size(), unassigned);
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    uint32_t& index = number[scene.triangle_surface[t]];
    if (index == unassigned) {
      index = static_cast<uint32_t>(listed.size());
      Surface& surface = listed.emplace_back(scene.surfaces[scene.triangle_surface[t]]);
      surface.lower = surface.upper = scene.vertices[scene.triangles[t][0]];
      surface.triangle_count = 0;
    }
    scene.triangle_surface[t] = index;
    Surface& surface = listed[index];
    ++surface.triangle_count;
    for (uint32_t v : scene.triangles[t]) {
      surface.lower = glm::min(surface.lower, scene.vertices[v]);
      surface.upper = glm::max(surface.upper, scene.vertices[v]);
    }
  }
  scene.surfaces = std::move(listed);
  uint32_t first = 0;
  std::vector<uint32_t> next;  // index at which each surface's next triangle is stored
  for (Surface& surface : scene.surfaces) {
    next.push_back(surface.first_triangle = first);
    first += surface.triangle_count;
  }
  scene.surface_triangles.resize(scene.triangles.size());
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) scene.surface_triangles[next[scene.triangle_surface[t]]++] = t;
}

void find_flat_edges(Scene& scene) {
  for (Edge& edge : scene.edges) edge.flat = is_flat(scene, edge);
}

std::vector<uint32_t> bodies_of(const Scene& scene) {
  Forest bodies(scene.triangles.size());
  for (const Edge& edge : scene.edges)
    for (uint32_t k = 1; k < edge.face_count; ++k)
      bodies.join(scene.edge_faces[edge.first_face], scene.edge_faces[edge.first_face + k]);
  std::vector<uint32_t> body(bodies.size());
  uint32_t count = 0;
  for (uint32_t t = 0; t < bodies.size(); ++t) {
    const uint32_t first = bodies.root(t);
    body[t] = first == t ? count++ : body[first];
  }
  return body;
}

}  // namespace wavetracer
