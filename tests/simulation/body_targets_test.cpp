// SPDX-License-Identifier: Apache-2.0
// Bodies by physical optics in runs: levels and phases against bodies that stand alone, near and far, both ways,
// shadows of the body itself, and that a body is no mirror as well.
#include <map>
#include <set>
#include <tuple>

#include "folders.hpp"
#include "radio/target_pieces.hpp"
#include "simulation/body_world.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

// Both ends see the same faces, as hidden ones would differ: a body that stands alone has no test of what hides them.
TEST_CASE("a plate and a box have the fields of bodies that stand alone, back and to the side, near and far") {
  const SceneFile scene(far_plate), box(one_box), plate(one_plate);
  for (const SceneFile* body : {&box, &plate})
    for (const double distance_m : {20e3, 200.0, 6.0}) {
      Points from, to;
      for (const double azimuth_deg : {0.7, 9.0, 31.0, 58.0})
        from.push_back(body_place + distance_m * direction(azimuth_deg, 3));
      for (const double azimuth_deg : {1.3, 22.0, 47.0, 80.0})
        to.push_back(body_place + distance_m * direction(azimuth_deg, 8));
      to.push_back(from[0]);
      Simulation simulation(body_world(scene, *body, from, to, 1, body == &plate));
      const Body mesh = body_of(simulation.models().front(), body_hz);
      REQUIRE(is_closed(mesh) == (body == &box));
      const Paths paths = simulation.run_frame(0).paths;
      std::vector<Channel> found(from.size() * to.size()), expected;
      for (const size_t i : echoes(paths))
        for (size_t k = 0; k < 4; ++k)
          found[paths.tx[i] * to.size() + paths.rx[i]][k] +=
              paths.a[i][k] * std::polar(1.0, -2 * std::numbers::pi * body_hz * paths.delay_s[i]);
      double strongest = 0;
      for (const glm::dvec3& tx : from)
        for (const glm::dvec3& rx : to) {
          expected.push_back(alone(mesh, tx, rx));
          strongest = std::max(strongest, std::abs(expected.back()[0]));
        }
      for (size_t i = 0; i < found.size(); ++i) {
        CAPTURE(distance_m);
        CAPTURE(i / to.size());
        CAPTURE(i % to.size());
        // Nearer, the polarization and the reflection of a piece are those of its middle, which matters in weak
        // directions.
        if (distance_m > 1000)
          CHECK(difference(found[i], expected[i]) < tenth_of_db);
        else
          CHECK(std::abs(found[i][0] - expected[i][0]) < tenth_of_db * strongest);
      }
    }
}

// Its largest faces: front, hood, windscreen, roof and side. Between them small differences of hidden parts count.
TEST_CASE("a car from a file, far away, has the cross section of the body that stands alone, without bounces") {
  const SceneFile scene(far_plate), unused(one_box);
  const std::string car = source_folder() + "/configs/scenes/car.ply";
  for (const auto& [azimuth_deg, elevation_deg] :
       {std::pair{0.05, 0.03}, {0.02, 75.95}, {0.03, 56.33}, {0.04, 89.95}, {90.02, 0.03}}) {
    const glm::dvec3 end = body_place + 20e3 * direction(azimuth_deg, elevation_deg);
    Config config = body_world(scene, unused, {end}, {end});
    config.vehicle_types[0].model = car;
    config.target_models[0].piece_m = 0.25;
    Simulation simulation(config);
    const Channel wanted = alone(body_of(simulation.models().front(), body_hz), end, end);
    const Paths paths = simulation.run_frame(0).paths;
    CAPTURE(azimuth_deg);
    CAPTURE(elevation_deg);
    CHECK(echoes(paths).size() > 50);
    CHECK(difference(heard(paths), wanted) < tenth_of_db);
  }
}

TEST_CASE("pieces of bodies: their areas add up, no edge is too long, and closed bodies are lit from outside") {
  const SceneFile scene(far_plate), box(one_box), plate(one_plate);
  const glm::dvec3 far(100, 0, 10);
  for (const bool closed : {true, false}) {
    const Simulation simulation(body_world(scene, closed ? box : plate, {far}, {far}, 1, !closed));
    for (const double piece_m : {10.0, 0.11, 0.04}) {
      glm::dvec3 across(0);
      double area_m2 = 0;
      for (const TargetPiece& piece : pieces_of_body(simulation.models().front(), piece_m, "box")) {
        const auto corner = [&](int k) {
          return glm::dvec3(piece.facet.corners[3 * k], piece.facet.corners[3 * k + 1], piece.facet.corners[3 * k + 2]);
        };
        for (int k = 0; k < 3; ++k) CHECK(glm::distance(corner(k), corner((k + 1) % 3)) <= piece_m);
        CHECK(glm::length(corner(0) + corner(1) + corner(2)) < 1e-12);
        const glm::dvec3 normal = 0.5 * glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        across += normal;
        area_m2 += glm::length(normal);
        CHECK((piece.lit_above && piece.lit_below) == !closed);
        if (closed) CHECK(glm::dot(normal, piece.centre_m) > 0);  // the middle of the box is inside
      }
      CHECK(area_m2 == doctest::Approx(closed ? 2 * (0.6 * 0.4 + 0.6 * 0.3 + 0.4 * 0.3) : 0.4 * 0.3).epsilon(1e-6));
      CHECK((glm::length(across) < 1e-7) == closed);
    }
  }
}

TEST_CASE("smaller pieces change the sum of a body by little, and each path is reciprocal") {
  const SceneFile scene(far_plate), box(one_box);
  const glm::dvec3 a = body_place + 9.0 * direction(12, 5), b = body_place + 14.0 * direction(40, 8);
  Config config = body_world(scene, box, {a}, {b});
  const Paths there = run(config).paths, back = run(body_world(scene, box, {b}, {a})).paths;
  REQUIRE(there.size() == back.size());
  REQUIRE(echoes(there).size() > 50);
  double largest = 0;
  for (const size_t i : echoes(there)) largest = std::max(largest, std::abs(there.a[i][0]));
  for (const size_t i : echoes(there)) {
    CHECK(std::abs(there.delay_s[i] - back.delay_s[i]) < 1e-20);
    for (size_t r = 0; r < 2; ++r)
      for (size_t t = 0; t < 2; ++t) CHECK(std::abs(there.a[i][2 * r + t] - back.a[i][2 * t + r]) < 1e-9 * largest);
  }
  config.target_models[0].piece_m = 0.03;
  const Paths fine = run(config).paths;
  CHECK(fine.size() > 8 * there.size());
  const Channel wanted = alone(body_of(Simulation(config).models().front(), body_hz), a, b);
  // The polarization of a piece is that of its middle, and its error is large beside the field in weak directions.
  CHECK(difference(heard(fine), wanted) < 0.015);
  CHECK(difference(heard(there), wanted) < 0.04);
  CHECK(difference(heard(there), wanted) > 2 * difference(heard(fine), wanted));
}

TEST_CASE("a body that is a target is no mirror, and hides waves as before") {
  const SceneFile scene(far_plate), plate(one_plate);
  const glm::dvec3 a = body_place + glm::dvec3(6, 1, 0.05), b = body_place + glm::dvec3(6, -1, 0.05);
  const glm::dvec3 behind = body_place + glm::dvec3(-6, -1, 0.02);
  Config config = body_world(scene, plate, {a}, {b, behind}, 1, true);
  const auto count = [](const Paths& paths, uint8_t kind, uint32_t rx) {
    size_t out = 0;
    for (size_t i = 0; i < paths.size(); ++i)
      for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
        out += paths.rx[i] == rx && paths.vertex_interaction[k] == kind && paths.vertex_instance[k] == 0;
    return out;
  };
  config.trace.target = false;
  CHECK(count(run(config).paths, reflection, 0) == 1);
  config.trace.target = true;
  const Paths paths = run(config).paths;
  CHECK(count(paths, reflection, 0) == 0);
  CHECK(count(paths, target_point, 0) > 10);
  CHECK(count(paths, target_point, 1) == 0);  // the wave behind the plate is that of free space, which the plate hides
  for (size_t i = 0; i < paths.size(); ++i) CHECK((paths.rx[i] == 0 || paths.depth[i] > 0));
  // The echo is that of the mirror, since the plate is large and near enough: 0.4 x 0.3 m are many Fresnel zones.
  config.trace.target = false;
  const Paths mirrored = run(config).paths;
  double mirror = 0;
  for (size_t i = 0; i < mirrored.size(); ++i)
    if (mirrored.rx[i] == 0 && mirrored.depth[i] == 1 && mirrored.vertex_instance[mirrored.vertex_offset[i]] == 0)
      mirror = std::abs(mirrored.a[i][0]);
  const double ratio = std::abs(heard(paths)[0]) / mirror;
  CHECK(ratio > 0.3);
  CHECK(ratio < 2);
}

TEST_CASE("one part of a body hides pieces of another, and faces that look away are dark") {
  std::vector<Quad> quads = solid_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.2});
  for (const Quad& quad : solid_box({-0.5, -0.5, 0.4}, {0.5, 0.5, 0.6})) quads.push_back(quad);
  const SceneFile scene(far_plate), body(quads);
  const auto levels = [&](const glm::dvec3& end) {
    std::map<int, size_t> out;  // the height of its pieces in tenths of a metre
    const Paths paths = run(body_world(scene, body, {end}, {end})).paths;
    for (const size_t i : echoes(paths))
      ++out[static_cast<int>(std::lround(10 * (paths.vertex_position_m[paths.vertex_offset[i]].z - body_place.z)))];
    return out;
  };
  auto above = levels(body_place + glm::dvec3(0.01, 0.02, 20));
  CHECK(above[6] > 100);
  CHECK(above[2] == 0);  // below the upper box
  CHECK(above[4] == 0);  // faces downwards
  auto below = levels(body_place + glm::dvec3(0.01, 0.02, -20));
  CHECK(below[0] > 100);
  CHECK(below[4] == 0);
}

TEST_CASE("the upper part of a body hides those pieces of the lower one whose lines of sight pass it") {
  const glm::dvec3 lower(-0.5, -0.5, 0.4), upper(0.5, 0.5, 0.6);
  std::vector<Quad> quads = solid_box({-0.5, -0.5, 0}, {0.5, 0.5, 0.2});
  const SceneFile scene(far_plate), below(quads);
  for (const Quad& quad : solid_box(lower, upper)) quads.push_back(quad);
  const SceneFile both(quads);
  const glm::dvec3 end = body_place + glm::dvec3(3, 0.4, 2);
  const auto top = [&](const SceneFile& body) {  // pieces of the lower box's roof, from the middle of the vehicle
    std::set<std::tuple<double, double>> out;
    const Paths paths = run(body_world(scene, body, {end}, {end})).paths;
    for (const size_t i : echoes(paths)) {
      const glm::dvec3 p = paths.vertex_position_m[paths.vertex_offset[i]] - body_place;
      if (std::abs(p.z - 0.2) < 1e-6) out.insert({std::round(1e5 * p.x), std::round(1e5 * p.y)});
    }
    return out;
  };
  // Does the line from the piece to the end pass the upper box?
  const auto passes = [&](const glm::dvec3& from) {
    const glm::dvec3 way = end - body_place - from;
    double first = 0, last = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (lower[axis] - from[axis]) / way[axis], b = (upper[axis] - from[axis]) / way[axis];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return first < last;
  };
  const auto all = top(below), seen = top(both);
  CHECK(all.size() > 200);
  size_t hidden = 0;
  for (const auto& [x, y] : all) {
    const bool passed = passes({1e-5 * x, 1e-5 * y, 0.2});
    hidden += passed;
    CHECK(seen.contains({x, y}) == !passed);
  }
  CHECK(hidden > 50);
  CHECK(hidden + 50 < all.size());
}
