// SPDX-License-Identifier: Apache-2.0
// Scenes of loose triangles and closed rooms for the tests of the passes, and rays aimed at their edges and vertices.
// Each triangle is a surface of its own, so that none is skipped as coplanar (but in scene_by_loader).
#pragma once
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "passes/on_device.hpp"
#include "scene/build_scene.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::test {

using Corners = std::array<glm::dvec3, 3>;

// A uniform number in [0, 1) that is the same with every standard library.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_()) * 0x1p-32; }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>((*this)() * count); }
  glm::dvec3 in_cube(double half) {
    const double x = between(-half, half), y = between(-half, half);
    return {x, y, between(-half, half)};
  }
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 p = in_cube(1);
      const double length = glm::length(p);
      if (length > 0.01 && length < 1) return p / length;
    }
  }

 private:
  std::mt19937 engine_;
};

inline Scene scene_of_triangles(const std::vector<Corners>& triangles) {
  Scene scene;
  scene.materials.push_back({.name = "metal", .a = 1, .c = 1e7});
  scene.objects.push_back("triangles");
  for (const Corners& c : triangles) {
    const auto index = static_cast<uint32_t>(scene.triangles.size());
    Surface surface;
    const glm::dvec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    if (glm::length(normal) > 0) surface.normal = glm::normalize(normal);
    surface.offset_m = glm::dot(surface.normal, c[0]);
    surface.lower = glm::min(c[0], glm::min(c[1], c[2]));
    surface.upper = glm::max(c[0], glm::max(c[1], c[2]));
    surface.first_triangle = index;
    surface.triangle_count = 1;
    scene.lower = index == 0 ? surface.lower : glm::min(scene.lower, surface.lower);
    scene.upper = index == 0 ? surface.upper : glm::max(scene.upper, surface.upper);
    scene.triangles.push_back({3 * index, 3 * index + 1, 3 * index + 2});
    scene.vertices.insert(scene.vertices.end(), c.begin(), c.end());
    scene.triangle_surface.push_back(index);
    scene.triangle_object.push_back(0);
    scene.surface_triangles.push_back(index);
    scene.surfaces.push_back(surface);
  }
  return scene;
}

inline std::vector<Corners> random_soup(size_t count, double extent, double size, uint32_t seed) {
  Random random(seed);
  std::vector<Corners> soup(count);
  for (Corners& corners : soup) {
    const glm::dvec3 centre = random.in_cube(extent);
    for (glm::dvec3& corner : corners) corner = centre + random.in_cube(size);
  }
  return soup;
}

enum class Room { box, ball };

// A closed room around `centre`: a cube of half side `size` whose faces are divided into cells x cells squares of two
// triangles, or the same blown up to a ball. 16 cells make 3,072 triangles. Shared corners are equal to the last bit.
inline std::vector<Corners> room(Room shape, int cells, double size, glm::dvec3 centre = {0, 0, 0}) {
  const auto corner = [&](int axis, int side, int i, int j) {
    glm::dvec3 p;
    p[axis] = side;
    p[(axis + 1) % 3] = 2.0 * i / cells - 1;
    p[(axis + 2) % 3] = 2.0 * j / cells - 1;
    if (shape == Room::ball) p /= std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    return centre + size * p;
  };
  std::vector<Corners> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = -1; side <= 1; side += 2)
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
          const glm::dvec3 a = corner(axis, side, i, j), b = corner(axis, side, i + 1, j);
          const glm::dvec3 c = corner(axis, side, i + 1, j + 1), d = corner(axis, side, i, j + 1);
          triangles.push_back({a, b, c});
          triangles.push_back({a, c, d});
        }
  return triangles;
}

// The same triangles through build_scene: welded, and recentred if they lie far off.
inline Scene scene_by_loader(const std::vector<Corners>& triangles) {
  RawScene raw;
  raw.file = "room";
  RawMesh mesh;
  mesh.name = "room";
  for (const Corners& corners : triangles) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  raw.meshes.push_back(mesh);
  ResolvedMaterials materials;
  materials.materials.push_back({.name = "metal", .a = 1, .c = 1e7});
  materials.mesh_material.push_back(0);
  return build_scene(raw, materials);
}

inline Float3 to_float(const glm::dvec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

inline glm::dvec3 to_double(const Float3& p) { return {p[0], p[1], p[2]}; }

inline Ray ray_towards(const glm::dvec3& from, const glm::dvec3& direction) {
  return {to_float(from), to_float(glm::normalize(direction))};
}

enum class Aim { edges, vertices, anywhere };

// Rays from points near the room's middle (within `spread` of it) at random points of its edges, at its vertices, or
// anywhere. In a closed room each of them hits something.
inline std::vector<Ray> aimed_rays(const std::vector<Corners>& room, Aim aim, size_t count, const glm::dvec3& centre,
                                   double spread, uint32_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  rays.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const Corners& triangle = room[random.below(static_cast<uint32_t>(room.size()))];
    const uint32_t corner = random.below(3);
    const glm::dvec3 from = centre + random.in_cube(spread), a = triangle[corner], b = triangle[(corner + 1) % 3];
    const glm::dvec3 target = aim == Aim::vertices ? a : a + random() * (b - a);
    rays.push_back(ray_towards(from, aim == Aim::anywhere ? random.direction() : target - from));
  }
  return rays;
}

}  // namespace wavetracer::test
