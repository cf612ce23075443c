// SPDX-License-Identifier: Apache-2.0
// Bodies: what is closed, what is refused, and bodies of scenes.
#include "bodies/body.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "bodies/bodies.hpp"
#include "contains.hpp"
#include "radio/material.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

namespace {

Body cube() { return box({1, 1, 1}); }

std::string problem_of(const Body& body) {
  try {
    check_body(body);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a cube is closed; it is not without a face, with a turned face, or inside out") {
  CHECK(is_closed(cube()));
  Body open = cube(), turned = cube(), inverse = cube();
  open.facets.pop_back();
  std::swap(turned.facets[2].corners[1], turned.facets[2].corners[3]);
  for (Facet& facet : inverse.facets) std::swap(facet.corners[1], facet.corners[3]);
  CHECK_FALSE(is_closed(open));
  CHECK_FALSE(is_closed(turned));
  CHECK_FALSE(is_closed(inverse));
}

TEST_CASE("facets that are none are refused by their numbers") {
  CHECK(problem_of(cube()).empty());
  CHECK(contains(problem_of(Body{}), "no facets"));
  const auto with = [](const Polygon& corners, uint32_t material = 0) {
    Body body = cube();
    body.facets.push_back({corners, material});
    return problem_of(body);
  };
  CHECK(contains(with({{0, 0, 0}, {1, 0, 0}}), "facet 6 of a body of 7 has fewer than three corners"));
  CHECK(contains(with({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), "has no area"));
  CHECK(contains(with({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}}), "is not flat"));
  CHECK(contains(with({{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}}), "is not convex"));
  CHECK(contains(with({{0, 0, 0}, {1, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}}), "finite"));
  CHECK(contains(with({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 3), "material 3, but there are 1"));
}

TEST_CASE("the body of a scene has its triangles in the coordinates of the file, and its materials") {
  Scene scene;
  scene.origin_m = {10, 0, 0};
  scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.triangles = {{0, 1, 2}};
  scene.triangle_surface = {0};
  scene.surfaces.resize(1);
  scene.surfaces[0].material = 1;
  scene.materials.resize(2);
  scene.materials[1] = {.name = "glass", .a = 6.31, .c = 0.0036, .d = 1.3394, .thickness_m = 0.004};
  const Body body = body_of(scene, 28e9);
  REQUIRE(body.facets.size() == 1);
  CHECK(body.facets[0].corners[1] == glm::dvec3(11, 0, 0));
  REQUIRE(body.materials[body.facets[0].material].size() == 1);
  CHECK(body.materials[1][0].permittivity == complex_permittivity(scene.materials[1], 28e9));
  CHECK(body.materials[1][0].thickness_m == 0.004);
}
