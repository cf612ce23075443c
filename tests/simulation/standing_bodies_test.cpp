// SPDX-License-Identifier: Apache-2.0
// Bodies of targets that stand: the waves of a parked vehicle with this body in this place, any orientation, and what
// is refused.
#include "simulation/body_world.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const std::vector<Quad> corner_of_plates{{{0, 0, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}},
                                         {{0, 0, -0.2}, {0, 0, 0.4}, {0, 0.4, 0}}};

// The vehicle of body_world, as a target that stands in its place.
Config standing_world(const SceneFile& scene, const SceneFile& body, const Points& from, const Points& to,
                      uint32_t bounces, const std::array<double, 3>& turned_deg) {
  Config config = body_world(scene, body, from, to, bounces);
  config.tracks.clear();
  config.target_models[0].on.clear();
  config.target_models[0].bounces = bounces;
  config.targets = {{.name = "corner",
                     .model = "facets",
                     .position_m = {body_place.x, body_place.y, body_place.z},
                     .orientation_deg = turned_deg,
                     .vehicle_type = "body"}};
  return config;
}

}  // namespace

TEST_CASE("a body of a target that stands has the paths of a vehicle that stands there") {
  const SceneFile scene(far_plate), body(corner_of_plates);
  const glm::dvec3 a = body_place + 9.0 * direction(40, 5), b = body_place + 14.0 * direction(49, 8);
  Config vehicle = body_world(scene, body, {a}, {b}, 2);
  vehicle.target_models[0].bounces = 2;
  const Paths drives = run(vehicle).paths;
  const Paths stands = run(standing_world(scene, body, {a}, {b}, 2, {0, 0, 0})).paths;
  REQUIRE(echoes(stands).size() > 50);
  REQUIRE(stands.size() == drives.size());
  CHECK(stands.vertex_interaction == drives.vertex_interaction);
  CHECK(stands.vertex_surface == drives.vertex_surface);
  for (size_t i = 0; i < stands.size(); ++i) {
    CHECK(std::abs(stands.delay_s[i] - drives.delay_s[i]) < 1e-18);
    CHECK(std::abs(stands.a[i][0] - drives.a[i][0]) < 1e-9 * std::abs(heard(drives)[0]));
  }
}

TEST_CASE("yaw, pitch and roll turn a body that stands: the waves are those of ends that are turned back") {
  const SceneFile scene(far_plate), body(corner_of_plates);
  const std::array<double, 3> turned_deg{25, -14, 33};
  const glm::dvec3 a = 9.0 * direction(40, 5), b = 14.0 * direction(49, 8);
  const double degree = std::numbers::pi / 180;
  const auto turned = [&](glm::dvec3 p) {  // roll about x, then pitch about y, then yaw about z, about fixed axes
    const auto about = [](const glm::dvec3& axis, double angle, const glm::dvec3& v) {
      return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
             axis * glm::dot(axis, v) * (1 - std::cos(angle));
    };
    p = about({1, 0, 0}, turned_deg[2] * degree, p);
    p = about({0, 1, 0}, turned_deg[1] * degree, p);
    return about({0, 0, 1}, turned_deg[0] * degree, p);
  };
  const Paths straight = run(standing_world(scene, body, {body_place + a}, {body_place + b}, 2, {0, 0, 0})).paths;
  const Paths tilted =
      run(standing_world(scene, body, {body_place + turned(a)}, {body_place + turned(b)}, 2, turned_deg)).paths;
  // Polarizations turn with the ends, so sums over all of them are compared.
  const auto power = [](const Channel& channel) {
    double sum = 0;
    for (const auto& value : channel) sum += std::norm(value);
    return sum;
  };
  REQUIRE(echoes(straight).size() > 50);
  CHECK(echoes(tilted).size() == echoes(straight).size());
  CHECK(power(heard(tilted)) == doctest::Approx(power(heard(straight))).epsilon(1e-6));
}

TEST_CASE("a body that stands hides what is behind it, and its velocity shifts its echoes alone") {
  const SceneFile scene(far_plate), body(one_box);
  const glm::dvec3 a = body_place + glm::dvec3(6, 0.02, 0.03), behind = body_place + glm::dvec3(-6, -0.02, 0.02);
  Config config = standing_world(scene, body, {a}, {a + glm::dvec3(0, 0.1, 0), behind}, 1, {0, 0, 0});
  config.targets[0].velocity_m_s = {3, 0, 0};
  const Paths paths = run(config).paths;
  size_t moving = 0;
  for (size_t i = 0; i < paths.size(); ++i) {
    if (paths.target[i] == no_target) {
      CHECK(paths.rx[i] == 0);
      continue;
    }
    moving += std::abs(paths.doppler_hz[i] - 2 * 3 / body_wave_m) < 0.01 * 2 * 3 / body_wave_m;
  }
  CHECK(moving == echoes(paths).size());
  CHECK(moving > 10);
  config.trace.target = false;  // the body stays: a mirror like that of a vehicle
  bool mirrored = false;
  const Paths without = run(config).paths;
  for (size_t i = 0; i < without.size(); ++i) mirrored = mirrored || (without.rx[i] == 0 && without.depth[i] == 1);
  CHECK(mirrored);
}

TEST_CASE("bodies that stand: types that nothing knows or that have no body are refused by their names") {
  const SceneFile scene(far_plate), body(one_box);
  const glm::dvec3 end = body_place + glm::dvec3(6, 0, 0);
  const auto message = [&](const std::string& type) -> std::string {
    Config config = standing_world(scene, body, {end}, {end + glm::dvec3(0, 1, 0)}, 1, {0, 0, 0});
    config.vehicle_types.push_back({.name = "ghost", .model = "none"});
    config.targets[0].vehicle_type = type;
    try {
      Simulation simulation(config);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(message("body").empty());
  CHECK(message("boddy").find("\"boddy\"") != std::string::npos);
  CHECK(message("ghost").find("no body") != std::string::npos);
}
