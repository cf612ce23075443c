// SPDX-License-Identifier: Apache-2.0
// Wheels and limbs of targets: places by formulas written once more, shifts against central differences in a curve, the
// spectrum of a wheel, frames that do not depend on those before them, and wheels that do not slip.
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>

#include "simulation/radar_world.hpp"
#include "simulation/target_parts.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/live.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double wheel_radius_m = 0.32, stride_m = 1.4, leg_m = 0.85, swing_deg = 27, walk_m_s = 1.3;

TargetPartConfig wheel(const std::string& model, double ahead, double left, uint32_t points) {
  return {.model = model,
          .kind = "wheel",
          .pivot_m = {ahead, left, wheel_radius_m},
          .radius_m = wheel_radius_m,
          .phase_deg = 10,
          .points = points,
          .rcs_dbsm = -15};
}

TargetPartConfig leg(const std::string& model, double phase_deg) {
  return {.model = model,
          .kind = "limb",
          .pivot_m = {0, phase_deg > 0 ? -0.1 : 0.1, 0.9},
          .length_m = leg_m,
          .swing_deg = swing_deg,
          .stride_m = stride_m,
          .phase_deg = phase_deg,
          .points = 2,
          .rcs_dbsm = -20};
}

TargetModelConfig body(const std::string& name, const std::string& on) {
  TargetModelConfig out;
  out.name = name;
  out.on = on;
  out.rcs_dbsm = {3};
  return out;
}

// A car with two wheels and a walker with two legs before one antenna at the origin.
Config world_of(const SceneFile& file, const std::vector<std::array<double, 4>>& drive, uint32_t rim_points = 6) {
  Config config = config_of(file.path(), {{0, 0, wheel_radius_m}}, {{0, 0.001, wheel_radius_m}}, 2000, 1);
  config.radio.frequency_hz = radar_hz;
  config.vehicle_types = {{.name = "pedestrian", .model = "none", .length_m = 0.5, .width_m = 0.5, .height_m = 1.8}};
  config.tracks = {
      {.id = "car", .waypoints = drive},
      {.id = "walker", .type = "pedestrian", .waypoints = {{0, 12, -6, 0}, {5, 12, -6 + 5 * walk_m_s, 0}}}};
  config.target_models = {body("car", "passenger"), body("walker", "pedestrian")};
  config.target_parts = {wheel("car", 1.3, 0.75, rim_points), wheel("car", -1.3, -0.75, rim_points), leg("walker", 0),
                         leg("walker", 180)};
  config.trace.reuse = false;
  return config;
}

// Target, point, and the numbers of mirrors before and after it.
using Key = std::array<uint64_t, 4>;

std::map<Key, size_t> rows_of(const Paths& paths) {
  std::map<Key, size_t> out;
  for (const size_t i : echoes(paths)) {
    uint64_t k = paths.vertex_offset[i];
    while (paths.vertex_interaction[k] != target_point) ++k;
    out[{paths.target[i], paths.vertex_surface[k], k - paths.vertex_offset[i], paths.vertex_offset[i + 1] - 1 - k}] = i;
  }
  return out;
}

const std::vector<std::array<double, 4>> curve{{0, 10, 0, 0}, {1, 22, 1, 0}, {2, 30, 9, 0}, {3, 31, 22, 0}};

}  // namespace

TEST_CASE("parts in a drive: shifts of wheels in a curve and of legs are those of the lengths of paths") {
  const SceneFile file(std::vector<Quad>{{{-300, -60, -40}, {600, 0, 0}, {0, 0, 120}}});  // a mirror aside
  for (const double time_s : {0.4, 1.45, 2.2}) {
    Config config = world_of(file, curve);
    config.trace.discovery = "beams";
    config.trace.target_reflections = 1;
    config.trace.max_depth = 3;
    constexpr double step_s = 1e-5;
    config.time = {time_s - step_s, time_s + step_s, step_s};
    Simulation drive(config);
    REQUIRE(drive.frame_count() == 3);
    const Paths before = drive.run_frame(0).paths, now = drive.run_frame(1).paths, after = drive.run_frame(2).paths;
    const auto rows_before = rows_of(before), rows_after = rows_of(after);
    double largest_hz = 0;
    for (const auto& [key, i] : rows_of(now)) {
      const double change_s = after.delay_s[rows_after.at(key)] - before.delay_s[rows_before.at(key)];
      const double expected_hz = -radar_hz * change_s / (drive.time_s(2) - drive.time_s(0));
      CAPTURE(key[0]);
      CAPTURE(key[1]);
      CAPTURE(key[2] + key[3]);
      CHECK(std::abs(now.doppler_hz[i] - expected_hz) < 1e-6 * 4 * 14 / radar_wavelength_m);
      largest_hz = std::max(largest_hz, std::abs(expected_hz));
    }
    CHECK(rows_of(now).size() == 4 * (1 + 12 + 1 + 4));  // the mirror before, after, both, none
    CHECK(largest_hz > 2 * 2 / radar_wavelength_m);
  }
}

TEST_CASE("the spectrum of a wheel goes from 0 to twice the shift of the car, and legs are where the formula says") {
  const SceneFile file(far_plate);
  constexpr double speed_m_s = 8;
  Config config = world_of(file, {{0, 400, 0, 0}, {10, 400 - 10 * speed_m_s, 0, 0}}, 7);
  const double turn_s = full_turn * wheel_radius_m / speed_m_s;
  config.time = {1, 1 + turn_s, turn_s / 40};
  Simulation drive(config);
  const double car_hz = 2 * speed_m_s / radar_wavelength_m;
  double lowest = 1e9, highest = 0;
  for (uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    const Paths paths = drive.run_frame(frame).paths;
    const double time_s = drive.time_s(frame);
    for (const auto& [key, i] : rows_of(paths)) {
      if (drive.targets()[key[0]].name == "car/car") {
        if (key[1] == 0) {
          CHECK(paths.doppler_hz[i] == doctest::Approx(car_hz).epsilon(1e-5));
        } else {
          lowest = std::min(lowest, paths.doppler_hz[i]);
          highest = std::max(highest, paths.doppler_hz[i]);
        }
      } else if (key[1] > 0) {  // legs of two points each
        const uint64_t number = key[1] - 1;
        const double side = number < 2 ? 1 : -1, arm_m = leg_m * (number % 2 == 0 ? 0.5 : 1);
        const double way_m = walk_m_s * time_s;
        const double angle =
            swing_deg / 360 * full_turn * std::sin(full_turn * way_m / stride_m + (side < 0 ? full_turn / 2 : 0));
        // It walks along y, so its left is -x.
        const glm::dvec3 expected(12 - side * 0.1, -6 + way_m + arm_m * std::sin(angle), 0.9 - arm_m * std::cos(angle));
        CHECK(glm::distance(paths.vertex_position_m[paths.vertex_offset[i]], expected) < 1e-9);
      }
    }
  }
  CHECK(highest / car_hz == doctest::Approx(2).epsilon(2e-3));
  CHECK(highest < 2 * car_hz);
  CHECK(std::abs(lowest) < 2e-3 * car_hz);
}

TEST_CASE("parts: a frame alone has the bits of a frame in a row") {
  const SceneFile file(far_plate);
  Config config = world_of(file, curve);
  config.time = {0.1, 2.9, 0.35};
  Simulation drive(config);
  std::vector<Paths> all;
  for (uint32_t frame = 0; frame < drive.frame_count(); ++frame) all.push_back(drive.run_frame(frame).paths);
  Simulation other(config);
  for (const uint32_t frame : {6u, 3u}) {
    const Paths alone = other.run_frame(frame).paths;
    CHECK(alone.delay_s == all[frame].delay_s);
    CHECK(alone.doppler_hz == all[frame].doppler_hz);
    CHECK(alone.vertex_position_m == all[frame].vertex_position_m);
  }
}

TEST_CASE("wheels do not slip: the lowest point rests, the highest is twice as fast, in curves as well") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  for (int trial = 0; trial < 20; ++trial) {
    const Travelled way{.way_m = 100.0 * any(), .velocity_m_s = 20.0 * any(), .rate_rad_s = {0, 0, unit(random)}};
    TargetPartConfig part = wheel("", unit(random), unit(random), 1);
    part.axis = {0.3 * unit(random), 1, 0.2 * unit(random)};
    const PartPoint at_zero = point_of_part(part, 0);
    for (const double angle : {0.0, full_turn / 2}) {
      PartPoint point = at_zero;  // at this angle from the top now
      point.phase_rad = angle - glm::dot(way.way_m, point.ahead) * full_turn / point.period_m;
      const PartPlace place = place_of(point, way);
      CHECK(glm::distance(place.arm_m, point.pivot_m + std::cos(angle) * wheel_radius_m * point.up) < 1e-9);
      const double centre_m_s = glm::dot(way.velocity_m_s + glm::cross(way.rate_rad_s, point.pivot_m), point.ahead);
      const double rolls_m_s = glm::dot(place.velocity_m_s, point.ahead);
      CHECK(rolls_m_s == doctest::Approx(angle > 0 ? -centre_m_s : centre_m_s));
    }
  }
}

// A car that goes straight on at 12 m/s, driven and live.
TEST_CASE("wheels of a live vehicle turn as those of a drive: by the frames that were sent, or by the way it tells") {
  const SceneFile file(far_plate);
  Config drive = world_of(file, {{0, 10, 1, 0}, {3, 46, 1, 0}});
  drive.tracks.resize(1);
  drive.target_models.resize(1);
  drive.target_parts.resize(2);
  drive.time = {0, 3, 0.25};
  Config config = drive;
  config.tracks.clear();
  config.time = {};
  config.live_vehicles = {{.type = "passenger", .count = 1}};
  config.live.margin_m = 600;
  Simulation driven(drive), live(config);
  const auto pose = [](double time_s) -> LivePose {
    LivePose out;
    out.id = "car";
    out.type = "passenger";
    out.position_m = {10 + 12 * time_s, 1, 0};
    return out;
  };
  const auto compare = [&](const Paths& found, double time_s, bool shifts) {
    const Paths wanted = driven.run_frame(static_cast<uint32_t>(std::lround(time_s / 0.25))).paths;
    const auto a = rows_of(found), b = rows_of(wanted);
    CAPTURE(time_s);
    REQUIRE(b.size() == 13);  // the car's own point and six of each wheel
    REQUIRE(a.size() == b.size());
    for (const auto& [key, i] : a) {
      CHECK(std::abs(found.delay_s[i] - wanted.delay_s[b.at(key)]) < 1e-16);
      if (shifts) CHECK(std::abs(found.doppler_hz[i] - wanted.doppler_hz[b.at(key)]) < 1e-4);
    }
  };
  LiveTraffic traffic;
  for (const double time_s : {0.0, 0.5, 1.0, 2.5})
    compare(live.run_poses(traffic, time_s, {{pose(time_s)}}).result.paths, time_s, time_s > 0);
  for (const double time_s : {1.25, 2.0, 2.5}) compare(live.run_between(traffic, time_s).result.paths, time_s, true);

  // Another source of poses begins late, and says how far its car has gone.
  LiveTraffic late;
  for (const double time_s : {1.5, 2.0, 3.0}) {
    LivePose told = pose(time_s);
    told.travelled_m = 12 * time_s;
    compare(live.run_poses(late, time_s, {{told}}).result.paths, time_s, time_s > 1.5);
  }
  LivePose wrong = pose(3.5);
  wrong.travelled_m = 1e10;
  CHECK_THROWS_WITH_AS(live.run_poses(late, 3.5, {{wrong}}),
                       "vehicle \"car\": travelled_m is 10000000000, beyond 1000000000 m", PoseError);

  // A jump does not turn the wheels: after it they are as they were, and the car is elsewhere.
  LiveTraffic jumping;
  live.run_poses(jumping, 0, {{pose(0)}});
  live.run_poses(jumping, 0.5, {{pose(0.5)}});
  const glm::dvec3 way_m = jumping.vehicles.at("car").way_m;
  live.run_poses(jumping, 0.6, {{pose(7.5)}});
  CHECK(jumping.vehicles.at("car").way_m == way_m);
  CHECK(way_m.x == doctest::Approx(6).epsilon(1e-12));
}
