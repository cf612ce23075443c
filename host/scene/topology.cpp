// Edges by sorting, surfaces by growing from the largest triangle.
// A surface's plane is that of its seed, or the one that its vertices were moved onto, and never changes meanwhile, so
// a chain of small bends cannot drift into a curve.
#include "scene/topology.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

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
        seed_of_(scene.triangles.size(), unassigned) {
    shapes_.reserve(scene.triangles.size());
    for (uint32_t t = 0; t < scene.triangles.size(); ++t) shapes_.push_back(triangle_shape(scene, t));
  }

  // The seed of every triangle's surface.
  std::vector<uint32_t> grow() {
    std::vector<uint32_t> order(shapes_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [this](uint32_t a, uint32_t b) {
      return shapes_[a].area_m2 != shapes_[b].area_m2 ? shapes_[a].area_m2 > shapes_[b].area_m2 : a < b;
    });
    for (uint32_t seed : order) {
      if (seed_of_[seed] == unassigned) grow_from(seed);
    }
    return std::move(seed_of_);
  }

  Plane plane_of(uint32_t t) const {
    if (flat_.triangle_plane[t] != no_plane) return flat_.planes[flat_.triangle_plane[t]];
    const dvec3 n = shapes_[t].area_m2 > 0 ? oriented(shapes_[t].normal) : dvec3(0, 0, 1);  // a strip that went flat
    return {n, glm::dot(n, scene_.vertices[scene_.triangles[t][0]])};
  }

 private:
  void grow_from(uint32_t seed) {
    const Plane plane = plane_of(seed);
    stack_.assign(1, seed);
    seed_of_[seed] = seed;
    while (!stack_.empty()) {
      const uint32_t t = stack_.back();
      stack_.pop_back();
      for (uint32_t e : triangle_edges_[t]) {
        const Edge& edge = scene_.edges[e];
        for (uint32_t i = 0; i < edge.face_count; ++i) {
          const uint32_t other = scene_.edge_faces[edge.first_face + i];
          if (seed_of_[other] != unassigned || material_[other] != material_[seed] || !continues(seed, other, plane))
            continue;
          seed_of_[other] = seed;
          stack_.push_back(other);
        }
      }
    }
  }

  bool continues(uint32_t seed, uint32_t t, const Plane& plane) const {
    if (flat_.triangle_plane[t] != flat_.triangle_plane[seed]) return false;
    return flat_.triangle_plane[t] != no_plane || lies_in_plane(scene_, t, shapes_[t], plane);
  }

  const Scene& scene_;
  std::span<const uint32_t> material_;
  std::span<const std::array<uint32_t, 3>> triangle_edges_;
  const Flattened& flat_;
  std::vector<TriangleShape> shapes_;
  std::vector<uint32_t> seed_of_, stack_;
};

bool is_flat(const Scene& scene, const Edge& edge) {
  const uint32_t* faces = scene.edge_faces.data() + edge.first_face;
  const uint32_t first = scene.triangle_surface[faces[0]];
  const dvec3 a = scene.vertices[edge.vertices[0]];
  const dvec3 along = scene.vertices[edge.vertices[1]] - a;
  const dvec3 side = glm::cross(scene.surfaces[first].normal, along);  // in the plane, across the edge
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
  // Divided, not multiplied by a reciprocal: the normals of axis-parallel triangles are exact.
  return {twice_area > 0 ? n / twice_area : dvec3(0), twice_area / 2, longest > 0 ? twice_area / longest : 0};
}

bool lies_in_plane(const Scene& scene, uint32_t t, const TriangleShape& shape, const Plane& plane) {
  if (shape.height_m > sliver_height_m && std::abs(glm::dot(shape.normal, plane.normal)) <= 1 - normal_tolerance)
    return false;
  return std::all_of(scene.triangles[t].begin(), scene.triangles[t].end(),
                     [&](uint32_t v) { return std::abs(height_over(plane, scene.vertices[v])) <= flat_as_it_is_m; });
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
      const dvec3 corner = scene.vertices[scene.triangles[t][0]];
      scene.surfaces.push_back(
          {plane.normal, plane.offset_m, corner, corner, triangle_material[seed], scene.triangle_object[seed], 0, 0});
    }
    scene.triangle_surface[t] = index;
    Surface& surface = scene.surfaces[index];
    ++surface.triangle_count;
    for (uint32_t v : scene.triangles[t]) {
      surface.lower = glm::min(surface.lower, scene.vertices[v]);
      surface.upper = glm::max(surface.upper, scene.vertices[v]);
    }
  }
  uint32_t first = 0;
  std::vector<uint32_t> next;  // where each surface's next triangle goes
  for (Surface& surface : scene.surfaces) {
    next.push_back(surface.first_triangle = first);
    first += surface.triangle_count;
  }
  scene.surface_triangles.resize(count);
  for (uint32_t t = 0; t < count; ++t) scene.surface_triangles[next[scene.triangle_surface[t]]++] = t;
}

void find_flat_edges(Scene& scene) {
  for (Edge& edge : scene.edges) edge.flat = is_flat(scene, edge);
}

}  // namespace wavetracer
