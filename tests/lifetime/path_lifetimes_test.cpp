// SPDX-License-Identifier: Apache-2.0
// Lifetimes of single paths in scenes of a few surfaces, compared with closed forms. frames_test.cpp compares them with
// frames.
#include "lifetime/path_lifetimes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "reference/quads.hpp"

using namespace wavetracer;

namespace {

struct Vertex {
  glm::dvec3 p;
  uint8_t interaction;
  uint32_t surface, instance = no_instance;
};

// The lifetime of one path from (-10, 0, 5) to (10, 0, 5).
double lifetime_m(const Scene& scene, const std::vector<Vertex>& vertices, double apart_m = 0,
                  const std::vector<Scene>& models = {}, const std::vector<Instance>& instances = {},
                  const std::vector<Placement>& placements = {}) {
  Paths paths;
  paths.tx = paths.rx = {0};
  paths.delay_s = {1e-7};
  for (const Vertex& vertex : vertices) {
    paths.vertex_position_m.push_back(vertex.p + scene.origin_m);
    paths.vertex_interaction.push_back(vertex.interaction);
    paths.vertex_surface.push_back(vertex.surface);
    paths.vertex_instance.push_back(vertex.instance);
  }
  paths.vertex_offset.push_back(vertices.size());
  WorldState state;
  state.instances = placements;
  state.transmitters = std::vector<EndState>{{.position_m = {-10, 0, 5}}};
  state.receivers = std::vector<EndState>{{.position_m = {10, apart_m, 5}}};
  const std::vector<double> out = PathLifetimes(scene, models, instances)(paths, state);
  REQUIRE(out.size() == 1);
  return out[0];
}

// The largest r for which r (L + 2 r) / (c L - 2 r) is below the margin m.
double closed_form_m(double length, double sine, double margin) {
  const double b = length + 2 * margin;
  return (std::sqrt(b * b + 8 * margin * sine * length) - b) / 4;
}

const reference::Quad ground{{-40, -1.5, 0}, {80, 0, 0}, {0, 3, 0}};

}  // namespace

TEST_CASE("a direct path lives until it has moved as far as the nearest surface is") {
  const double slack_m = 1e-3 + 2e-5;
  const Scene wall = reference::scene_of_quads({{{0, 2, 0}, {0, 3, 0}, {0, 0, 9}}});
  CHECK(lifetime_m(wall, {}) == doctest::Approx(2 - slack_m).epsilon(1e-4));
  // A slope of 3 to 20 leads by the same wall.
  CHECK(lifetime_m(wall, {}, 3) == doctest::Approx(0.5 * std::cos(std::atan(3.0 / 20)) - slack_m).epsilon(1e-4));
  const Scene roof = reference::scene_of_quads({{{-3, -2, 5.75}, {6, 0, 0}, {0, 4, 0}}});
  CHECK(lifetime_m(roof, {}) == doctest::Approx(0.75 - slack_m).epsilon(1e-4));
  CHECK(lifetime_m(reference::scene_of_quads({{{0, 500, 0}, {0, 3, 0}, {0, 0, 9}}}), {}) == most_lifetime_m);
}

TEST_CASE("a body that comes as far as the ends go halves the lifetime of a direct path beside it") {
  const Scene none, body = reference::scene_of_quads(reference::box_walls({-1, -1, -1}, {1, 1, 1}));
  const std::vector<Instance> instances{{"a", "car", 0, 0, 0}};
  CHECK(lifetime_m(none, {}, 0, {body}, instances, {{.position_m = {0, 5, 5}}}) ==
        doctest::Approx((4 - 1e-3) / 2).epsilon(1e-4));
  CHECK(lifetime_m(none, {}, 0, {body}, instances, {{.position_m = {0, 5, 5}, .present = false}}) == most_lifetime_m);
}

TEST_CASE("a reflection lives until its point may leave its surface") {
  const Scene flat = reference::scene_of_quads({ground});
  const double length = std::hypot(20, 10), sine = 10 / length;
  CHECK(lifetime_m(flat, {{{0, 0, 0}, reflection, 0}}) ==
        doctest::Approx(closed_form_m(length, sine, 1.5)).epsilon(1e-9));
  // A wall on the ground ends the leg before.
  const Scene beside = reference::scene_of_quads({ground, {{-9, 0.3, 0}, {18, 0, 0}, {0, 0, 1}}});
  CHECK(lifetime_m(beside, {{{0, 0, 0}, reflection, 0}}) <= closed_form_m(length, sine, 0.3));
  CHECK(lifetime_m(beside, {{{0, 0, 0}, reflection, 0}}) > 0.05);
  // A surface in the plane of the mirror ends no leg: a neighbour of another material.
  const Scene neighbour = reference::scene_of_quads({ground, {{-40, 1.5, 0}, {80, 0, 0}, {0, 9, 0}}});
  CHECK(lifetime_m(neighbour, {{{0, 0, 0}, reflection, 0}}) ==
        doctest::Approx(closed_form_m(length, sine, 1.5)).epsilon(1e-9));
}

TEST_CASE("a reflection by a body lives shorter than by the static scene, and the longer the larger the body is") {
  const Scene none;
  const std::vector<Instance> instances{{"a", "car", 0, 0, 0}};
  const auto on_plate = [&](double half_m) {
    const Scene plate = reference::scene_of_quads({{{-half_m, -half_m, 0}, {2 * half_m, 0, 0}, {0, 2 * half_m, 0}}});
    return lifetime_m(none, {{{0, 0, 0}, reflection, 0, 0}}, 0, {plate}, instances, {{}});
  };
  CHECK(on_plate(1.5) > 0);
  CHECK(on_plate(1.5) < closed_form_m(std::hypot(20, 10), 10 / std::hypot(20, 10), 1.5) / 3);
  CHECK(on_plate(3) > on_plate(1.5));
}

TEST_CASE("a diffraction lives until its point may leave its edge") {
  const reference::Quad screen{{0, -2, 0}, {0, 6, 0}, {0, 0, 5.5}};
  Scene scene = reference::scene_of_quads({screen});
  scene.wedges = {{.start = {0, -2, 5.5},
                   .along = {0, 1, 0},
                   .length_m = 6,
                   .face = {0, 0, -1},
                   .normal = {-1, 0, 0},
                   .exterior_rad = 6.283185307179586,
                   .surface = {0, 0},
                   .plane = {0, 0}}};
  const double length = 2 * std::hypot(10, 0.5);
  CHECK(lifetime_m(scene, {{{0, 0, 5.5}, diffraction, 0}}) ==
        doctest::Approx(closed_form_m(length, 1, 2)).epsilon(1e-9));
}

TEST_CASE("paths without a known bound have the lifetime 0") {
  const Scene flat = reference::scene_of_quads({ground});
  CHECK(lifetime_m(flat, {{{0, 0, 0}, scattering, 0}}) == 0);
  // Both reflections are in one place.
  CHECK(lifetime_m(flat, {{{0, 0, 0}, reflection, 0}, {{0, 0, 0}, reflection, 0}}) == 0);
}
