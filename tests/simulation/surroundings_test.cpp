// SPDX-License-Identifier: Apache-2.0
// Finds the surroundings of a place: compared with brute force over all triangles, and bodies whose inside is known.
// Scenes are parallelograms that the tests write.
#include "simulation/surroundings.hpp"

#include <random>

#include "scene/load.hpp"
#include "simulation/place_cases.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

Scene load(const std::vector<Part>& parts) {
  const SceneFile file(parts);
  return load_scene_file(file.path(), {});
}

std::vector<Quad> box(const dvec3& lower, const dvec3& upper) { return reference::box_walls(lower, upper); }

// A box without the face of this number among those of box_walls().
std::vector<Quad> open_box(const dvec3& lower, const dvec3& upper, const dvec3& towards) {
  std::vector<Quad> out = box(lower, upper);
  std::erase_if(out, [&](const Quad& q) {
    const dvec3 middle = q.corner + 0.5 * (q.u + q.v) - 0.5 * (lower + upper);
    return glm::dot(middle, towards) > 0.49 * glm::dot(upper - lower, glm::abs(towards));
  });
  return out;
}

// Recentred.
dvec3 at(const Scene& scene, const dvec3& p) { return p - scene.origin_m; }

}  // namespace

TEST_CASE("crossings are those of every triangle, in order") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-20, 20), size(-6, 6);
  const auto point = [&](auto& from) { return dvec3(from(random), from(random), from(random)); };
  std::vector<Quad> quads;
  for (int i = 0; i < 60; ++i) quads.push_back({point(place), point(size), point(size)});
  const Scene scene = load({{quads}});
  const Surroundings around(scene);
  size_t met = 0;
  for (int i = 0; i < 400; ++i) {
    const dvec3 a = 3.0 * point(place), b = point(place);
    std::vector<std::pair<double, uint32_t>> expected, found;
    for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
      const auto& [p, q, r] = scene.triangles[t];
      // Signed volumes: the line passes the triangle where a and b are on either side, and all edges on one.
      const auto volume = [](const dvec3& w, const dvec3& x, const dvec3& y, const dvec3& z) {
        return glm::dot(glm::cross(x - w, y - w), z - w);
      };
      const dvec3 &u = scene.vertices[p], &v = scene.vertices[q], &w = scene.vertices[r];
      const double va = volume(u, v, w, a), vb = volume(u, v, w, b);
      const double s1 = volume(a, b, u, v), s2 = volume(a, b, v, w), s3 = volume(a, b, w, u);
      if ((va > 0) == (vb > 0) || (s1 > 0) != (s2 > 0) || (s2 > 0) != (s3 > 0)) continue;
      expected.push_back({glm::distance(a, b) * va / (va - vb), t});
    }
    std::sort(expected.begin(), expected.end());
    for (const auto& [distance_m, triangle] : around.crossings(a, b)) found.push_back({distance_m, triangle});
    REQUIRE(found.size() == expected.size());
    for (size_t k = 0; k < found.size(); ++k) {
      CHECK(found[k].second == expected[k].second);
      CHECK(found[k].first == doctest::Approx(expected[k].first).epsilon(1e-9));
    }
    met += found.size();
  }
  CHECK(met > 100);
}

TEST_CASE("closed bodies hold what is inside of them, to the last place, their middles too") {
  const dvec3 lower{10, 20, 0}, upper{30, 28, 9};
  std::vector<Part> parts{{{ground}}, {box(lower, upper)}, {box({-40, -40, 0}, {-30, -35, 3})}};
  const Scene scene = load(parts);
  const Surroundings around(scene);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> x(0, 40), y(10, 38), z(0.1, 15);
  size_t inside = 0;
  for (int i = 0; i < 3000; ++i) {
    // Every third on the diagonals of the faces, where a line straight up or aside meets two triangles or none.
    dvec3 p(x(random), y(random), z(random));
    if (i % 3 == 0) p = lower + (upper - lower) * dvec3(0.5, 0.5, z(random) / 15);
    const bool within = glm::all(glm::greaterThan(p, lower)) && glm::all(glm::lessThan(p, upper));
    const auto body = around.body_at(at(scene, p));
    CHECK(body.has_value() == within);
    if (body) CHECK(around.name_of(body->object) == "\"part-1\"");
    if (body) CHECK(around.small(*body));
    inside += within;
  }
  CHECK(inside > 1000);
}

TEST_CASE("a house without a floor is closed, a garage without a door and a bridge are not, a sheet never is") {
  const dvec3 lower{-4, -6, 0}, upper{4, 6, 5}, p{0.5, -1.2, 1.5};
  const auto closed = [&](const std::vector<Quad>& quads) {
    const Scene scene = load({{{ground}}, {quads}});
    return Surroundings(scene).body_at(at(scene, p)).has_value();
  };
  CHECK(closed(box(lower, upper)));
  CHECK(closed(open_box(lower, upper, {0, 0, -1})));
  CHECK_FALSE(closed(open_box(lower, upper, {0, 0, 1})));
  CHECK_FALSE(closed(open_box(lower, upper, {1, 0, 0})));
  CHECK_FALSE(closed(open_box(lower, upper, {0, -1, 0})));
  CHECK_FALSE(closed({{{-90, -90, 5}, {180, 0, 0}, {0, 180, 0}}}));
}

TEST_CASE("a room that is the scene is not small") {
  const Scene scene = load({{box({0, 0, 0}, {10, 8, 3})}});
  const Surroundings around(scene);
  const auto body = around.body_at(at(scene, {3, 4, 1.5}));
  REQUIRE(body);
  CHECK_FALSE(around.small(*body));
}

TEST_CASE("below the ground, above the next surface, on a surface, outside") {
  const Scene scene = load({{{ground}}, {box({10, 10, 2}, {20, 20, 6})}});
  const Surroundings around(scene);
  const auto depth = around.below_ground(at(scene, {3.3, 4.4, -1.5}));
  REQUIRE(depth);
  CHECK(depth->metres == doctest::Approx(1.5));
  CHECK(around.name_of(depth->object) == "\"part-0\"");
  CHECK_FALSE(around.below_ground(at(scene, {3.3, 4.4, 0})));
  CHECK_FALSE(around.below_ground(at(scene, {3.3, 4.4, 1})));
  CHECK_FALSE(around.below_ground(at(scene, {13, 14.5, 1})));    // below the box, above the ground
  CHECK_FALSE(around.below_ground(at(scene, {300, 14.5, -1})));  // no ground there
  CHECK(around.height_above(at(scene, {3.3, 4.4, 2.5}), 1).value_or(-9) == doctest::Approx(2.5));
  CHECK(around.height_above(at(scene, {3.3, 4.4, -0.7}), 1).value_or(-9) == doctest::Approx(-0.7));
  CHECK_FALSE(around.height_above(at(scene, {3.3, 4.4, -1.2}), 1));
  CHECK(around.height_above(at(scene, {13, 14.5, 7}), 1).value_or(-9) == doctest::Approx(1));
  CHECK(around.object_at(at(scene, {3.3, 4.4, 0.00009})) == 0);
  CHECK_FALSE(around.object_at(at(scene, {3.3, 4.4, 0.00011})));
  CHECK(around.object_at(at(scene, {9.99991, 14, 4})) == 1);
  CHECK(around.object_at(at(scene, {10 - 6e-5, 20 + 6e-5, 4})) == 1);  // at an edge
  CHECK_FALSE(around.object_at(at(scene, {10 - 8e-5, 20 + 8e-5, 4})));
  CHECK(around.outside_m(at(scene, {103, 104, 50})) == doctest::Approx(5));
  CHECK(around.outside_m(at(scene, {3, 99, -50})) == 0);
}

TEST_CASE("a scene without triangles holds nothing") {
  const Scene scene;
  const Surroundings around(scene);
  CHECK_FALSE(around.body_at({1, 2, 3}));
  CHECK_FALSE(around.below_ground({0, 0, -1}));
  CHECK(around.crossings({0, 0, -1}, {0, 0, 1}).empty());
}
