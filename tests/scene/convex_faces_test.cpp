// SPDX-License-Identifier: Apache-2.0
// Convex faces: a point of a surface's plane is inside of all sides exactly if it is inside of a triangle; a surface
// that is no convex polygon without holes has no sides.
#include "scene/convex_faces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <random>

#include "scene/load.hpp"
#include "wavetracer/config.hpp"

using namespace wavetracer;

namespace {

using Corners = std::array<glm::dvec2, 3>;

// One surface of triangles in a plane that is turned and moved.
Scene in_plane(const std::vector<Corners>& triangles) {
  const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3{1, -2, 0.3}));
  const glm::dvec3 x = turn * glm::dvec3{1, 0, 0}, y = turn * glm::dvec3{0, 1, 0}, at{31.5, -12.25, 7};
  Scene scene;
  Surface& surface = scene.surfaces.emplace_back();
  surface.normal = glm::cross(x, y);
  surface.offset_m = glm::dot(surface.normal, at);
  surface.triangle_count = static_cast<uint32_t>(triangles.size());
  for (const Corners& corners : triangles) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    scene.surface_triangles.push_back(static_cast<uint32_t>(scene.triangles.size()));
    scene.triangles.push_back({first, first + 1, first + 2});
    for (const glm::dvec2& p : corners) scene.vertices.push_back(at + p.x * x + p.y * y);
  }
  return scene;
}

std::vector<Corners> rectangle(double x0, double y0, double x1, double y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}}}, {{{x1, y1}, {x0, y1}, {x0, y0}}}};
}

std::vector<Corners> joined(std::vector<std::vector<Corners>> parts) {
  std::vector<Corners> out;
  for (const auto& part : parts) out.insert(out.end(), part.begin(), part.end());
  return out;
}

std::vector<Corners> regular(int corners) {
  std::vector<Corners> out;
  const auto at = [&](int k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    return glm::dvec2{3 * std::cos(angle), 3 * std::sin(angle)};
  };
  for (int k = 1; k + 1 < corners; ++k) out.push_back({at(0), at(k), at(k + 1)});
  return out;
}

size_t sides(const std::vector<Corners>& triangles) { return convex_faces(in_plane(triangles)).sides.size(); }

// Whichever way its corners go round.
bool in_triangle(const std::array<glm::dvec3, 3>& t, const glm::dvec3& normal, const glm::dvec3& p) {
  int left = 0;
  for (int i = 0; i < 3; ++i) left += glm::dot(glm::cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) > 0;
  return left == 0 || left == 3;
}

}  // namespace

TEST_CASE("polygons that are convex have as many sides as corners, however they are cut into triangles") {
  CHECK(sides(rectangle(0, 0, 4, 3)) == 4);
  CHECK(sides({{{{0, 0}, {2, 0}, {0, 1}}}}) == 3);
  CHECK(sides(joined({rectangle(0, 0, 1, 3), rectangle(1, 0, 4, 3)})) == 4);
  CHECK(sides({{{{0, 0}, {4, 0}, {2, 2}}},
               {{{4, 0}, {4, 4}, {2, 2}}},
               {{{4, 4}, {0, 4}, {2, 2}}},
               {{{0, 4}, {0, 0}, {2, 2}}}}) == 4);
  CHECK(sides(regular(6)) == 6);
  CHECK(sides(regular(max_face_sides)) == max_face_sides);
}

TEST_CASE("corners that turn in, holes, gaps, triangles over one another and too many sides: no sides") {
  CHECK(sides(joined({rectangle(0, 0, 2, 1), rectangle(0, 1, 1, 3)})) == 0);  // an L
  CHECK(sides(joined({rectangle(0, 0, 3, 1), rectangle(0, 2, 3, 3), rectangle(0, 1, 1, 2), rectangle(2, 1, 3, 2)})) ==
        0);
  CHECK(sides(joined({rectangle(0, 0, 1, 3), rectangle(1.001, 0, 4, 3)})) == 0);  // a slit of a millimetre
  const std::vector<Corners> half = {rectangle(0, 0, 4, 3)[0]};
  CHECK(sides(joined({half, half})) == 0);  // twice the half of a rectangle has its area
  CHECK(sides(regular(max_face_sides + 1)) == 0);
  CHECK(convex_faces(Scene{}).first == std::vector<uint32_t>{0});
}

TEST_CASE("a city: points are inside of all sides exactly where they are in a triangle; nearly all walls are convex") {
  Config config;
  config.scene.generate = "--blocks 2x2";
  const Scene scene = load_scene(config);
  const ConvexFaces faces = convex_faces(scene);
  REQUIRE(faces.first.size() == scene.surfaces.size() + 1);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(-0.3, 1.3);
  size_t convex = 0, inside = 0, outside = 0;
  for (size_t s = 0; s < scene.surfaces.size(); ++s) {
    if (faces.first[s] == faces.first[s + 1]) continue;
    ++convex;
    const Surface& surface = scene.surfaces[s];
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (uint32_t k = 0; k < surface.triangle_count; ++k) {
      const auto& t = scene.triangles[scene.surface_triangles[surface.first_triangle + k]];
      triangles.push_back({scene.vertices[t[0]], scene.vertices[t[1]], scene.vertices[t[2]]});
    }
    for (int i = 0; i < 50; ++i) {
      const auto& [a, b, c] = triangles[random() % triangles.size()];
      const glm::dvec3 p = a + part(random) * (b - a) + part(random) * (c - a);
      double above = 1e300;
      for (uint32_t k = faces.first[s]; k < faces.first[s + 1]; ++k)
        above = std::min(above, glm::dot(glm::dvec3(faces.sides[k]), p) - faces.sides[k].w);
      if (std::abs(above) < 1e-6) continue;
      const bool met = std::ranges::any_of(triangles, [&](const auto& t) { return in_triangle(t, surface.normal, p); });
      CHECK(met == (above > 0));
      ++(met ? inside : outside);
    }
  }
  CHECK(convex > 0.9 * static_cast<double>(scene.surfaces.size()));
  CHECK(inside > 1000);
  CHECK(outside > 1000);
}
