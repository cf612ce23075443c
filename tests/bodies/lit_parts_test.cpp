// SPDX-License-Identifier: Apache-2.0
// Lit parts of facets, against rays to points that are drawn on them.
#include "bodies/lit_parts.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <random>

#include "bodies/bodies.hpp"

using namespace wavetracer;

namespace {

bool inside(const Polygon& polygon, glm::dvec3 p) {
  const glm::dvec3 normal = area_vector(polygon);
  for (size_t i = 0; i < polygon.size(); ++i)
    if (glm::dot(glm::cross(polygon[(i + 1) % polygon.size()] - polygon[i], p - polygon[i]), normal) < 0) return false;
  return true;
}

bool blocks(const Polygon& polygon, glm::dvec3 from, glm::dvec3 to) {
  const Plane plane = plane_of(polygon);
  const double a = height_over(plane, from), b = height_over(plane, to);
  if (a * b >= 0 || std::abs(b) < 1e-9) return false;
  return inside(polygon, from + (to - from) * (a / (a - b)));
}

Body many_triangles(uint32_t seed, int count) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> draw;
  std::vector<Polygon> triangles;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 middle(draw(random), draw(random), draw(random));
    Polygon t;
    for (int k = 0; k < 3; ++k) t.push_back(middle + glm::dvec3(draw(random), draw(random), draw(random)) * 0.7);
    triangles.push_back(t);
  }
  return conductor(triangles);
}

double area_of(const std::vector<Polygon>& parts) {
  double sum = 0;
  for (const Polygon& part : parts) sum += glm::length(area_vector(part));
  return sum;
}

glm::dvec3 point_on(const Polygon& t, std::mt19937_64& random) {
  std::uniform_real_distribution<double> draw(0, 1);
  double u = draw(random), v = draw(random);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v;
}

}  // namespace

TEST_CASE("a point of a facet is in one of its lit parts if no other facet blocks the way to the source") {
  std::mt19937_64 random(1);
  size_t dark = 0, bright = 0;
  for (const uint32_t seed : {1u, 2u, 3u}) {
    const Body body = many_triangles(seed, 25);
    const LitParts lit(body);
    for (const glm::dvec3 source : {glm::dvec3(5, 1, 2), glm::dvec3(0.1, 0.2, 0), glm::dvec3(-300, 20, 80)})
      for (uint32_t facet = 0; facet < 25; ++facet) {
        const auto parts = lit({source, {}, {}}, facet);
        for (int i = 0; i < 100; ++i) {
          const glm::dvec3 p = point_on(body.facets[facet].corners, random);
          size_t in = 0;
          for (const Polygon& part : parts) in += inside(part, p);
          bool free = true;
          for (uint32_t other = 0; other < 25; ++other)
            free = free && (other == facet || !blocks(body.facets[other].corners, source, p));
          CHECK(in == (free ? 1 : 0));
          ++(free ? bright : dark);
        }
      }
  }
  CHECK(dark > 5000);
  CHECK(bright > 5000);
}

TEST_CASE("by a mirror, a point is lit if both legs are free and the mirror's point is in the lit part") {
  std::mt19937_64 random(2);
  const Body body = many_triangles(7, 12);
  const LitParts lit(body);
  const glm::dvec3 source(4, -3, 2);
  size_t bright = 0;
  for (uint32_t mirror = 0; mirror < 12; ++mirror)
    for (const Polygon& part : lit({source, {}, {}}, mirror)) {
      const Beam beam = lit.reflected({source, {}, {}}, mirror, part);
      for (uint32_t facet = 0; facet < 12; ++facet) {
        if (facet == mirror) continue;
        const auto parts = lit(beam, facet);
        for (int i = 0; i < 100; ++i) {
          const glm::dvec3 p = point_on(body.facets[facet].corners, random);
          const Plane plane = lit.towards(source, mirror);
          const double a = height_over(plane, beam.source), b = height_over(plane, p);
          const glm::dvec3 q = beam.source + (p - beam.source) * (a / (a - b));
          bool free = b > 0 && inside(part, q);
          for (uint32_t other = 0; other < 12 && free; ++other)
            free = other == facet || other == mirror || !blocks(body.facets[other].corners, q, p);
          size_t in = 0;
          for (const Polygon& one : parts) in += inside(one, p);
          CHECK(in == (free ? 1 : 0));
          bright += free;
        }
      }
    }
  CHECK(bright > 50);
}

TEST_CASE("parts of a facet do not overlap: their areas sum up to what rays find") {
  const Body body = conductor({parallelogram({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                               parallelogram({-0.25, -0.25, 1}, {0.5, 0, 0}, {0, 0.5, 0}),
                               parallelogram({0.1, 0.1, 1.5}, {0.2, 0, 0}, {0, 0.2, 0})});
  const LitParts lit(body);
  // From a height of 2 the first small square throws a shadow of twice its size; the second one of 4 times, part of
  // which is within the shadow of the first: [0.4, 1.2]^2 and [-0.5, 0.5]^2 share 0.1^2, and 1.2 is beyond the plate.
  CHECK(area_of(lit({{0, 0, 2}, {}, {}}, 0)) == doctest::Approx(4 - 1 - 0.36 + 0.01));
}
