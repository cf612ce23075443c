// SPDX-License-Identifier: Apache-2.0
// Tests frames made by hand, whose coherence is known, and what the printed formulas give for them. Printed: equations
// 6.3 and 6.4 of the thesis, over outputs in which every list holds hits only.
#include "study/coherence.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include <random>
#include <stdexcept>

using namespace wavetracer::study;

namespace {

std::vector<glm::dvec3> cloud(size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-100, 100);
  std::vector<glm::dvec3> out;
  for (size_t i = 0; i < count; ++i) {
    const double x = uniform(random), y = uniform(random);
    out.emplace_back(x, y, uniform(random));
  }
  return out;
}

std::vector<Hit> hits_at(const std::vector<glm::dvec3>& points) {
  std::vector<Hit> out;
  for (const glm::dvec3& point : points) out.push_back({point, 10, static_cast<uint32_t>(out.size() / 10), 0});
  return out;
}

// Equation 6.4 as printed: points by their place in the output, and a sum that is not divided by 3.
double printed_correlation(const std::vector<Hit>& a, const std::vector<Hit>& b) {
  const std::vector<glm::dvec3> points_a = hit_points(a), points_b = hit_points(b);
  const size_t count = std::min(points_a.size(), points_b.size());
  double squares = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> x, y;
    for (size_t i = 0; i < count; ++i) {
      x.push_back(points_a[i][axis]);
      y.push_back(points_b[i][axis]);
    }
    squares += pearson(x, y) * pearson(x, y);
  }
  return std::sqrt(squares);
}

Hit hit(double x, double y, double z, uint32_t surface, double distance_m = 1) {
  return {{x, y, z}, distance_m, surface, surface};
}

}  // namespace

TEST_CASE("correlate: equal, moved and mirrored clouds") {
  const std::vector<glm::dvec3> a = cloud(500, 1);
  std::vector<glm::dvec3> equal = a, moved, mirrored;
  for (const glm::dvec3& p : a) {
    moved.push_back(2.0 * p + glm::dvec3(1e4, -7, 3));
    mirrored.push_back(-p);
  }
  for (const auto* b : {&equal, &moved}) {
    const PointCorrelation same = correlate(a, *b);
    CHECK(same.total == doctest::Approx(1));
    CHECK(same.pooled == doctest::Approx(1));
  }
  const PointCorrelation opposite = correlate(a, mirrored);
  CHECK(opposite.component.y == doctest::Approx(-1));
  CHECK(opposite.total == doctest::Approx(1));  // a length of coefficients has no sign
  CHECK(opposite.pooled == doctest::Approx(-1));
  const PointCorrelation other = correlate(a, cloud(500, 2));
  CHECK(other.total < 5 / std::sqrt(500.0));
  CHECK(std::abs(other.pooled) < 5 / std::sqrt(500.0));
}

TEST_CASE("correlate: one component agrees, one does not, one is constant") {
  const std::vector<glm::dvec3> a = {{-3, 1, 5}, {3, 1, 5.00001}, {-3, -1, 5}, {3, -1, 4.99999}},
                                b = {{-3, 1, 8}, {3, -1, 8}, {-3, -1, 8}, {3, 1, 8}};
  const PointCorrelation found = correlate(a, b);
  CHECK(found.component.x == doctest::Approx(1));
  CHECK(std::abs(found.component.y) < 1e-12);
  CHECK(std::isnan(found.component.z));
  CHECK(found.total == doctest::Approx(std::sqrt(0.5)));  // over the two that are defined
  CHECK(found.pooled == doctest::Approx(36.0 / 40));      // 4 * 9 of 4 * (9 + 1)
}

TEST_CASE("correlate: where nothing is defined") {
  const std::vector<glm::dvec3> none, one = {{1, 2, 3}}, still(3, {0.1, 0.2, 0.3});
  for (const auto* points : {&none, &one, &still}) {
    const PointCorrelation found = correlate(*points, *points);
    CHECK(std::isnan(found.total));
    CHECK(std::isnan(found.pooled));
    CHECK(std::isnan(found.component.x));
  }
  CHECK_THROWS_AS(correlate(one, still), std::invalid_argument);
}

TEST_CASE("equal frames: the printed formula gives sqrt(3), ours 1") {
  const FrameHits frame = {hits_at(cloud(1000, 3))};
  CHECK(printed_correlation(frame[0], frame[0]) == doctest::Approx(std::sqrt(3.0)));
  const DepthCoherence found = compare_frames(frame, frame).at(0);
  CHECK(found.points.total == doctest::Approx(1));
  CHECK(found.both == 1);
  CHECK(found.same_surface == 1);
  CHECK(found.same_sequence == 1);
}

TEST_CASE("one ray that misses: the printed pairing sees other rays, ours the same ones") {
  const FrameHits before = {hits_at(cloud(1000, 4))};
  FrameHits after = before;
  after[0][0] = Hit{};
  CHECK(printed_correlation(before[0], after[0]) < 0.3);
  const DepthCoherence found = compare_frames(before, after).at(0);
  CHECK(found.points.total == doctest::Approx(1));
  CHECK(found.points.pooled == doctest::Approx(1));
  CHECK(found.pairs == 999);
  CHECK(found.either == 1000);
  CHECK(found.both == doctest::Approx(0.999));
}

TEST_CASE("frames share surfaces at a depth, and sequences up to it") {
  const FrameHits a = {{hit(0, 0, 0, 1), hit(1, 0, 0, 1), hit(2, 0, 1, 2), hit(3, 1, 0, 3)},
                       {hit(0, 5, 0, 7), hit(1, 5, 0, 7), hit(2, 5, 1, 8), Hit{}}},
                  b = {{hit(0, 0, 0, 1), hit(1, 0, 0, 4), hit(2, 0, 1, 2), Hit{}},
                       {hit(0, 5, 0, 7), hit(1, 5, 0, 7), Hit{}, Hit{}}};
  const std::vector<DepthCoherence> found = compare_frames(a, b);
  REQUIRE(found.size() == 2);
  CHECK(found[0].pairs == 3);
  CHECK(found[0].either == 4);
  CHECK(found[0].same_surface == doctest::Approx(2.0 / 3));
  CHECK(found[0].same_sequence == doctest::Approx(2.0 / 3));
  CHECK(found[1].pairs == 2);
  CHECK(found[1].either == 3);
  CHECK(found[1].same_surface == 1);
  CHECK(found[1].same_sequence == 0.5);  // ray 1 comes from another surface
}

TEST_CASE("frames of which no ray hits, of other numbers of rays and of other depths") {
  const FrameHits empty = {std::vector<Hit>(5)}, deeper = {std::vector<Hit>(5), std::vector<Hit>(5)},
                  more = {std::vector<Hit>(6)};
  const std::vector<DepthCoherence> found = compare_frames(empty, deeper);
  REQUIRE(found.size() == 1);
  CHECK(found[0].either == 0);
  CHECK(std::isnan(found[0].both));
  CHECK(std::isnan(found[0].same_surface));
  CHECK(std::isnan(found[0].points.total));
  CHECK_THROWS_AS(compare_frames(empty, more), std::invalid_argument);
}

TEST_CASE("coherence along the launch order: surfaces of ten rays, every third a miss") {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 3000; ++i) points.emplace_back(i % 2, 0, 0);
  std::vector<Hit> hits = hits_at(points);  // ten rays per surface
  const std::vector<uint32_t> lags = {1, 4, 10, 3000};
  const auto full = coherence_along(hits, lags);
  CHECK(full[0].pairs == 2999);
  CHECK(full[0].same_surface == doctest::Approx(2700.0 / 2999));  // nine of ten neighbours
  CHECK(full[1].same_surface == doctest::Approx(1800.0 / 2996));  // six of ten
  CHECK(full[2].same_surface == 0);
  CHECK(full[0].same_primitive == 1);
  CHECK(full[0].points == doctest::Approx(-1).epsilon(1e-3));
  CHECK(full[1].points == doctest::Approx(1).epsilon(1e-3));
  CHECK(std::isnan(full[0].distance));  // all 10 m
  CHECK(full[3].pairs == 0);
  CHECK(std::isnan(full[3].same_surface));
  for (size_t i = 0; i < hits.size(); i += 3) hits[i] = Hit{};
  const auto gaps = coherence_along(hits, lags);
  CHECK(gaps[0].pairs == 1000);  // 1 and 2, 4 and 5, ...
  CHECK(gaps[0].points == doctest::Approx(-1).epsilon(1e-3));
}
