// SPDX-License-Identifier: Apache-2.0
// Tests of the conversion from the scene's doubles to float32 triangles.
#include <doctest/doctest.h>

#include <cmath>

#include "accel/triangles.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

namespace {

Scene scene_of(glm::dvec3 first) {
  Scene scene;
  scene.file = "street.xml";
  scene.vertices = {first, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.triangle_surface = {5, 9};
  return scene;
}

}  // namespace

TEST_CASE("vertices are the nearest float32, indices are kept") {
  const auto triangles = accel_triangles(scene_of({0.1, -1234.5678, 1e-50}));
  REQUIRE(triangles.size() == 2);
  CHECK(triangles[0].v[0][0] == 0.1f);
  CHECK(triangles[0].v[0][1] == -1234.5678f);
  CHECK(triangles[0].v[0][2] == 0.0f);
  CHECK(triangles[1].v[1][1] == 1.0f);
  CHECK(triangles[1].primitive == 1);
  CHECK(triangles[1].surface == 9);
}

TEST_CASE("negative zeros become positive") {
  const auto triangles = accel_triangles(scene_of({-0.0, -1e-60, 0.0}));
  CHECK_FALSE(std::signbit(triangles[0].v[0][0]));
  CHECK_FALSE(std::signbit(triangles[0].v[0][1]));
}

TEST_CASE("what float32 cannot hold is an error that says where") {
  CHECK_THROWS_WITH_AS(accel_triangles(scene_of({1e39, 0, 0})), doctest::Contains("street.xml: triangle 0"),
                       InputError);
}
