// SPDX-License-Identifier: Apache-2.0
// beam_facets: facets cover what their triangles cover, are convex, and are few where triangles are many.
#include "passes/beam_facets.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

glm::dvec3 corner(const Facets& facets, const wt_facet& facet, uint32_t i) {
  return facets.corners[facet.first_corner + i % facet.count];
}

double area(const Facets& facets, const wt_facet& facet) {
  glm::dvec3 sum(0.0);
  for (uint32_t i = 1; i + 1 < facet.count; ++i)
    sum += glm::cross(corner(facets, facet, i) - corner(facets, facet, 0),
                      corner(facets, facet, i + 1) - corner(facets, facet, 0));
  return 0.5 * glm::length(sum);
}

// Checks the promises of every facet; returns the area of all.
double check(const Facets& facets) {
  double sum = 0;
  for (const wt_facet& facet : facets.facets) {
    REQUIRE(facet.count >= 3);
    REQUIRE(facet.count <= WT_FACET_CORNERS);
    const glm::dvec3 normal(facet.normal[0], facet.normal[1], facet.normal[2]);
    CHECK(std::abs(glm::length(normal) - 1) < 1e-14);
    for (uint32_t i = 0; i < facet.count; ++i) {
      const glm::dvec3 a = corner(facets, facet, i), b = corner(facets, facet, i + 1), c = corner(facets, facet, i + 2);
      CHECK(glm::dot(glm::cross(b - a, c - b), normal) >= -1e-11);
      CHECK(facet.low <= glm::dot(normal, a));
      CHECK(facet.high >= glm::dot(normal, a));
    }
    sum += area(facets, facet);
  }
  return sum;
}

// A grid of nx x ny squares in the plane z = slope x, cut along alternating diagonals. hole: without one square.
std::vector<SurfaceTriangle> grid(int nx, int ny, double slope, bool hole) {
  std::vector<SurfaceTriangle> out;
  const auto at = [&](int i, int j) { return glm::dvec3(i, j, slope * i); };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      if (hole && i == nx / 2 && j == ny / 2) continue;
      const bool other = (i + j) % 2 == 1;
      const glm::dvec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      out.push_back({{a, b, other ? d : c}, 7});
      out.push_back({{other ? b : a, c, d}, 7});
    }
  return out;
}

}  // namespace

TEST_CASE("two triangles are a square, and a hexagon of four triangles is one facet") {
  const Facets square = make_facets(grid(1, 1, 0.25, false));
  REQUIRE(square.facets.size() == 1);
  CHECK(square.facets[0].count == 4);
  CHECK(square.facets[0].surface == 7);
  CHECK(check(square) == doctest::Approx(std::sqrt(1 + 0.25 * 0.25)));
  std::vector<SurfaceTriangle> hexagon;
  const auto at = [](int i) {
    return glm::dvec3(std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), 2);
  };
  for (int i = 1; i < 5; ++i) hexagon.push_back({{at(0), at(i), at(i + 1)}, 1});
  const Facets one = make_facets(hexagon);
  CHECK(one.facets.size() == 1);
  CHECK(check(one) == doctest::Approx(1.5 * std::sqrt(3)));
}

TEST_CASE("grids with and without a hole keep their area, and become at most half as many") {
  for (const bool hole : {false, true}) {
    CAPTURE(hole);
    const std::vector<SurfaceTriangle> triangles = grid(7, 5, 0.5, hole);
    const Facets facets = make_facets(triangles);
    CHECK(check(facets) == doctest::Approx((35 - hole) * std::sqrt(1.25)));
    CHECK(facets.facets.size() <= triangles.size() / 2);
  }
}

TEST_CASE("triangles are put together neither over a concave corner nor over a bend, nor across surfaces") {
  const glm::dvec3 a{0, 0, 0}, b{4, 0, 0}, c{1, 1, 0}, d{0, 4, 0}, up{4, 4, 1e-6};
  CHECK(make_facets(std::vector<SurfaceTriangle>{{{a, b, c}, 0}, {{a, c, d}, 0}}).facets.size() == 2);
  CHECK(make_facets(std::vector<SurfaceTriangle>{{{a, b, d}, 0}, {{b, up, d}, 0}}).facets.size() == 2);
  CHECK(make_facets(std::vector<SurfaceTriangle>{{{a, b, d}, 0}, {{b, {4, 4, 0}, d}, 1}}).facets.size() == 2);
  CHECK(make_facets(std::vector<SurfaceTriangle>{{{a, b, d}, 0}, {{b, {4, 4, 0}, d}, 0}}).facets.size() == 1);
}

TEST_CASE("triangles without an area are left out; no triangles, no facets") {
  CHECK(make_facets(std::vector<SurfaceTriangle>{{{glm::dvec3(0), {1, 0, 0}, {2, 0, 0}}, 0}}).facets.empty());
  CHECK(make_facets({}).facets.empty());
}
