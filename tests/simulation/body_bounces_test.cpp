// SPDX-License-Identifier: Apache-2.0
// Bounces within bodies in runs, beside bodies that stand alone and closed forms of corner reflectors.
#include <fmt/format.h>

#include <map>

#include "folders.hpp"
#include "simulation/body_world.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Two plates at a right angle, of `across` by `high` metres, which look along (1, 1, 0). The edge is along z.
std::vector<Quad> dihedral_of(double across, double high) {
  return {{{0, 0, -high / 2}, {across, 0, 0}, {0, 0, high}}, {{0, 0, -high / 2}, {0, 0, high}, {0, across, 0}}};
}

// Three squares, which look along (1, 1, 1).
std::vector<Quad> trihedral_of(double side) {
  return {{{0, 0, 0}, {side, 0, 0}, {0, side, 0}},
          {{0, 0, 0}, {0, side, 0}, {0, 0, side}},
          {{0, 0, 0}, {0, 0, side}, {side, 0, 0}}};
}

Config bouncing_world(const SceneFile& scene, const SceneFile& body, const Points& from, const Points& to,
                      uint32_t bounces, double piece_m) {
  Config config = body_world(scene, body, from, to, std::max(bounces, 1u));
  config.target_models[0].piece_m = piece_m;
  config.target_models[0].bounces = bounces;
  return config;
}

// The sum of echoes with so many interactions.
Channel heard_after(const Paths& paths, uint32_t facets, uint32_t rx = 0) {
  Channel out{};
  for (const size_t i : echoes(paths))
    if (paths.rx[i] == rx && paths.depth[i] == facets)
      for (size_t k = 0; k < 4; ++k)
        out[k] += paths.a[i][k] * std::polar(1.0, -2 * std::numbers::pi * body_hz * paths.delay_s[i]);
  return out;
}

// Those of the body that stands alone.
Channel alone_after(const Body& body, const glm::dvec3& from, const glm::dvec3& to, uint32_t facets) {
  PhysicalOptics options;
  options.max_bounces = facets;
  options.reciprocal = true;
  options.phase_error_rad = 0.01;
  options.amplitude_error = 0.003;
  std::vector<Echo> echoes = scattered(body, from - body_place, to - body_place, body_hz, options);
  std::erase_if(echoes, [&](const Echo& echo) { return echo.facets.size() != facets; });
  Channel out = sum_of(echoes, body_hz);
  for (std::complex<double>& value : out) value *= body_wave_m / (4 * std::numbers::pi);
  return out;
}

// The radar cross section in dB over 1 m^2 of a channel between isotropic antennas at one place.
double section_db(const std::complex<double>& a, double distance_m) {
  const double four_pi = 4 * std::numbers::pi;
  return 10 *
         std::log10(std::norm(a) * four_pi * four_pi * four_pi * std::pow(distance_m, 4) / (body_wave_m * body_wave_m));
}

}  // namespace

TEST_CASE("a dihedral in a run sends back 8 pi a^2 b^2 / lambda^2, and each bounce is that of the body alone") {
  const double a = 12 * body_wave_m, b = 15 * body_wave_m, distance_m = 20e3;
  const SceneFile scene(far_plate), body(dihedral_of(a, b));
  const glm::dvec3 axis = body_place + distance_m * direction(45, 0);
  Simulation simulation(bouncing_world(scene, body, {axis}, {axis}, 2, 0.05));
  const Paths paths = simulation.run_frame(0).paths;
  const Body mesh = body_of(simulation.models().front(), body_hz);
  const double most_db = 10 * std::log10(8 * std::numbers::pi * a * a * b * b / (body_wave_m * body_wave_m));
  const Channel all = heard(paths);
  MESSAGE(fmt::format("dihedral of 12 wavelengths: {:+.3f} and {:+.3f} dB", section_db(all[0], distance_m) - most_db,
                      section_db(all[3], distance_m) - most_db));
  CHECK(std::abs(section_db(all[0], distance_m) - most_db) < 0.1);
  CHECK(std::abs(section_db(all[3], distance_m) - most_db) < 0.1);
  CHECK(difference(heard_after(paths, 2), alone_after(mesh, axis, axis, 2)) < tenth_of_db);
  // Half of the bounces have the mirror before the piece, and half of them after it.
  size_t before = 0, after = 0;
  for (const size_t i : echoes(paths)) {
    if (paths.depth[i] != 2) continue;
    const uint64_t first = paths.vertex_offset[i];
    CHECK(paths.vertex_instance[first] == 0);
    CHECK(paths.vertex_instance[first + 1] == 0);
    before += paths.vertex_interaction[first] == reflection;
    after += paths.vertex_interaction[first + 1] == reflection;
  }
  CHECK(before > 100);
  CHECK(before == after);
}

TEST_CASE("without bounces a corner has single scattering alone, and the default has none") {
  const SceneFile scene(far_plate), body(dihedral_of(0.3, 0.3));
  const glm::dvec3 axis = body_place + 50.0 * direction(40, 5);
  Config config = bouncing_world(scene, body, {axis}, {axis}, 1, 0.05);
  const Paths one = run(config).paths;
  config.target_models[0].bounces.reset();
  const Paths none = run(config).paths;
  CHECK(one.a == none.a);
  for (const size_t i : echoes(one)) CHECK(one.depth[i] == 1);
}

TEST_CASE("a trihedral of squares has 12 pi a^4 / lambda^2, with the triple bounces of the body alone") {
  const double a = 12 * body_wave_m, distance_m = 20e3;
  const SceneFile scene(far_plate), body(trihedral_of(a));
  const glm::dvec3 axis = body_place + distance_m * glm::normalize(glm::dvec3(1));
  Simulation simulation(bouncing_world(scene, body, {axis}, {axis}, 3, 0.03));
  const Paths paths = simulation.run_frame(0).paths;
  const Body mesh = body_of(simulation.models().front(), body_hz);
  const double most_db = 10 * std::log10(12 * std::numbers::pi * std::pow(a, 4) / (body_wave_m * body_wave_m));
  const Channel all = heard(paths), wanted = alone_after(mesh, axis, axis, 3);
  for (const size_t k : {0u, 3u}) {
    MESSAGE(fmt::format("trihedral of 12 wavelengths: {:+.3f} dB", section_db(all[k], distance_m) - most_db));
    CHECK(std::abs(section_db(all[k], distance_m) - most_db) < 0.3);
  }
  CHECK(difference(heard_after(paths, 3), wanted) < 3 * tenth_of_db);
}

TEST_CASE("a car from a file, with bounces, before its front and side: the body that stands alone with bounces") {
  const SceneFile scene(far_plate), unused(one_box);
  for (const auto& [azimuth_deg, elevation_deg] : {std::pair{0.05, 0.03}, {90.02, 0.03}}) {
    const glm::dvec3 end = body_place + 20e3 * direction(azimuth_deg, elevation_deg);
    Config config = bouncing_world(scene, unused, {end}, {end}, 2, 0.25);
    config.vehicle_types[0].model = source_folder() + "/configs/scenes/car.ply";
    Simulation simulation(config);
    const Body mesh = body_of(simulation.models().front(), body_hz);
    const Channel once = alone(mesh, end, end), twice = alone_after(mesh, end, end, 2);
    Channel wanted;
    for (size_t k = 0; k < 4; ++k) wanted[k] = once[k] + twice[k];
    const double off = difference(heard(simulation.run_frame(0).paths), wanted);
    MESSAGE(fmt::format("car at {} degrees: off by {:.4f}; bounces are {:.4f} of it", azimuth_deg, off,
                        difference(once, wanted)));
    CHECK(off < tenth_of_db);
  }
}

// Off the axis the border of the beam of a mirror cuts pieces, which are lit or dark as a whole.
TEST_CASE("off its axis, near and far, the bounces of a dihedral tend to those of the body alone") {
  const SceneFile scene(far_plate), body(dihedral_of(0.5, 0.4));
  for (const double distance_m : {20e3, 8.0})
    for (const auto& [from_deg, to_deg] : {std::pair{30.0, 30.0}, {38.0, 39.0}, {58.0, 58.0}}) {
      const glm::dvec3 a = body_place + distance_m * direction(from_deg, 0),
                       b = body_place + distance_m * direction(to_deg, 0);
      std::vector<double> errors;
      for (const double piece_m : {0.1, 0.02}) {
        Simulation simulation(bouncing_world(scene, body, {a}, {b}, 2, piece_m));
        const Channel wanted = alone_after(body_of(simulation.models().front(), body_hz), a, b, 2);
        errors.push_back(difference(heard_after(simulation.run_frame(0).paths, 2), wanted));
      }
      CAPTURE(distance_m);
      CAPTURE(from_deg);
      MESSAGE(fmt::format("at {} m, {} and {} degrees: off by {:.3f} with pieces of 0.1 m, {:.3f} with 0.02 m",
                          distance_m, from_deg, to_deg, errors[0], errors[1]));
      CHECK(errors[0] < 0.15);
      CHECK(errors[1] < 0.04);
    }
}

TEST_CASE("bounces are reciprocal, path by path, and the floor leaves out the weak ones alone") {
  const SceneFile scene(far_plate), body(trihedral_of(0.3));
  const glm::dvec3 a = body_place + 9.0 * direction(40, 33), b = body_place + 14.0 * direction(49, 38);
  Config config = bouncing_world(scene, body, {a}, {b}, 3, 0.1);
  const Paths there = run(config).paths, back = run(bouncing_world(scene, body, {b}, {a}, 3, 0.1)).paths;
  REQUIRE(there.size() == back.size());
  std::map<uint32_t, size_t> depths;
  double largest = 0;
  for (const size_t i : echoes(there)) {
    ++depths[there.depth[i]];
    largest = std::max(largest, std::abs(there.a[i][0]));
  }
  CHECK(depths[2] > 50);
  CHECK(depths[3] > 50);
  for (const size_t i : echoes(there)) {
    CHECK(std::abs(there.delay_s[i] - back.delay_s[i]) < 1e-19);
    for (size_t r = 0; r < 2; ++r)
      for (size_t t = 0; t < 2; ++t) CHECK(std::abs(there.a[i][2 * r + t] - back.a[i][2 * t + r]) < 1e-9 * largest);
  }
  double strongest_db = -1e3;
  for (const size_t i : echoes(there)) strongest_db = std::max(strongest_db, there.gain_db[i]);
  config.trace.target_floor_db = strongest_db - 6;
  const Paths strong = run(config).paths;
  const auto count = [&](const Paths& paths) {
    size_t out = 0;
    for (const size_t i : echoes(paths)) out += paths.gain_db[i] > strongest_db - 6;
    return out;
  };
  CHECK(count(strong) == count(there));
  config.trace.target_floor_db = strongest_db + 60;  // the bound is that of a piece without any phases
  CHECK(echoes(run(config).paths).empty());
}

TEST_CASE("what stands between the plates of a corner hides its bounces, and other bodies have none by its mirrors") {
  std::vector<Quad> quads = dihedral_of(0.5, 0.4);
  const SceneFile scene(far_plate), open(quads);
  quads.push_back({{0.05, 0.05, -0.5}, {0.3, 0.3, 0}, {0, 0, 1}});  // a wall along the axis
  const SceneFile shut(quads);
  const glm::dvec3 axis = body_place + 30.0 * direction(45, 0);
  const auto bounced = [&](const SceneFile& body) {
    const Paths paths = run(bouncing_world(scene, body, {axis}, {axis}, 2, 0.05)).paths;
    return std::abs(heard_after(paths, 2)[0]);
  };
  CHECK(bounced(shut) < 0.3 * bounced(open));
}

TEST_CASE("shifts of bounces are those of the lengths of their paths, on a body that turns") {
  const SceneFile scene(far_plate), body(dihedral_of(0.5, 0.4));
  Config config = bouncing_world(scene, body, {{40, 25, 11}}, {{38, 20, 9}}, 2, 0.1);
  config.tracks[0].waypoints = {{0, 0, 0, 10}, {1, 9, 0.2, 10}, {2, 18, 0.8, 10}};
  constexpr double time_s = 0.9, step_s = 1e-5;
  config.time = {time_s - step_s, time_s + step_s, step_s};
  config.trace.reuse = false;
  Simulation drive(config);
  REQUIRE(drive.frame_count() == 3);
  using Steps = std::vector<uint32_t>;
  const auto rows = [](const Paths& paths) {
    std::map<Steps, size_t> out;
    for (const size_t i : echoes(paths)) {
      Steps steps;
      for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
        steps.push_back(paths.vertex_interaction[k]);
        steps.push_back(paths.vertex_surface[k]);
      }
      if (paths.depth[i] == 2) out[steps] = i;
    }
    return out;
  };
  const Paths before = drive.run_frame(0).paths, now = drive.run_frame(1).paths, after = drive.run_frame(2).paths;
  const auto rows_before = rows(before), rows_after = rows(after);
  size_t compared = 0;
  for (const auto& [steps, i] : rows(now)) {
    if (!rows_before.contains(steps) || !rows_after.contains(steps)) continue;
    ++compared;
    const double change_s = after.delay_s[rows_after.at(steps)] - before.delay_s[rows_before.at(steps)];
    const double expected_hz = -body_hz * change_s / (drive.time_s(2) - drive.time_s(0));
    CHECK(std::abs(now.doppler_hz[i] - expected_hz) < 1e-6 * 2 * 10 / body_wave_m);
  }
  CHECK(compared > 20);
}
