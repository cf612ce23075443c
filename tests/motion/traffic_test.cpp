// SPDX-License-Identifier: Apache-2.0
// Generated traffic: no two vehicles touch, all keep to the right, motion is smooth, the same everywhere; FCD and back.
// Overlap is tested by separating axes of the vehicles' rectangles, streets by their formula in traffic_streets.hpp.
#include "motion/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "motion/fcd_writer.hpp"
#include "motion/pose.hpp"
#include "motion/vehicle_types.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Approx;
using doctest::Contains;

namespace {

TrafficOptions options_of(uint64_t seed, uint32_t vehicles, double duration_s, double step_s = 0.1,
                          StreetGrid grid = {6, 6, 80, 20}) {
  return {grid, seed, vehicles, duration_s, step_s};
}

struct Rectangle {
  double x, y, ux, uy, half_length, half_width;  // centre, unit vector ahead, half sizes
};

Rectangle footprint(const VehicleType& type, const Sample& s) {
  return {s.position_m.x,      s.position_m.y,    std::cos(s.yaw_rad),
          std::sin(s.yaw_rad), type.length_m / 2, type.width_m / 2};
}

// Two rectangles are apart where one of their four axes tells them apart (S. Gottschalk and others, 1996).
bool touch(const Rectangle& a, const Rectangle& b) {
  const auto apart_along = [&](double nx, double ny) {
    const auto reach = [&](const Rectangle& r) {
      return r.half_length * std::abs(r.ux * nx + r.uy * ny) + r.half_width * std::abs(r.ux * ny - r.uy * nx);
    };
    return std::abs((b.x - a.x) * nx + (b.y - a.y) * ny) > reach(a) + reach(b);
  };
  return !apart_along(a.ux, a.uy) && !apart_along(-a.uy, a.ux) && !apart_along(b.ux, b.uy) && !apart_along(-b.uy, b.ux);
}

// Pairs of vehicles that touch at a sample, over all samples.
int touching_pairs(const Trajectories& t) {
  int out = 0;
  for (size_t k = 0; k < t.tracks.at(0).samples.size(); ++k) {
    std::vector<Rectangle> at;
    for (const Track& track : t.tracks) at.push_back(footprint(t.types[track.type], track.samples[k]));
    std::sort(at.begin(), at.end(), [](const Rectangle& a, const Rectangle& b) { return a.x < b.x; });
    for (size_t i = 0; i < at.size(); ++i) {
      for (size_t j = i + 1; j < at.size() && at[j].x - at[i].x < 10; ++j) out += touch(at[i], at[j]);
    }
  }
  return out;
}

double mean_speed_m_s(const Trajectories& t, size_t sample) {
  double sum = 0;
  for (const Track& track : t.tracks) sum += track.samples.at(sample).speed_m_s;
  return sum / static_cast<double>(t.tracks.size());
}

// Returns the signed distance from the nearest centre line of a street.
double off_centre_m(double x, uint32_t blocks, const StreetGrid& grid) {
  const double pitch_m = grid.block_m + grid.street_m, shift_m = blocks / 2.0 * pitch_m;
  return std::remainder(x + shift_m, pitch_m);
}

}  // namespace

TEST_CASE("rectangles that touch, and that do not") {
  const Rectangle a{0, 0, 1, 0, 2, 1};
  const double r = std::sqrt(0.5);
  CHECK(touch(a, {3.9, 0, 1, 0, 2, 1}));
  CHECK_FALSE(touch(a, {4.1, 0, 1, 0, 2, 1}));
  CHECK_FALSE(touch(a, {0, 2.1, 1, 0, 2, 1}));
  CHECK(touch(a, {2.5, 1.5, r, r, 2, 1}));
  CHECK_FALSE(touch(a, {3.6, 2.6, -r, r, 2, 1}));  // only an axis of the second separates them
}

TEST_CASE("no two vehicles ever touch") {
  const TrafficOptions cases[] = {
      options_of(1, 20, 60),
      options_of(2, 100, 60),
      options_of(3, 400, 60),
      options_of(4, 840, 30),  // every slot
      options_of(5, 40, 120, 0.25, {2, 2, 60, 12}),
      options_of(6, 20, 60, 1, {1, 1, 100, 40}),
      options_of(7, 60, 60, 0.1, {3, 2, 60, 15}),
  };
  for (const TrafficOptions& options : cases) {
    CAPTURE(options.seed);
    const Trajectories t = generate_traffic(options);
    CHECK(t.tracks.size() == options.vehicles);
    CHECK(touching_pairs(t) == 0);
  }
}

TEST_CASE("dense traffic goes on: nobody is stuck") {
  const Trajectories t = generate_traffic(options_of(3, 400, 120, 0.5));
  for (const Track& track : t.tracks) {
    CAPTURE(track.id);
    double driven_m = 0;
    for (size_t k = 1; k < track.samples.size(); ++k) {
      driven_m += glm::distance(track.samples[k].position_m, track.samples[k - 1].position_m);
    }
    CHECK(driven_m > 50);
  }
  // If every slot is taken, vehicles around a block come to wait for one another; they must find another way.
  const Trajectories full = generate_traffic(options_of(3, 840, 600, 1));
  CHECK(std::all_of(full.tracks.begin(), full.tracks.end(), [](const Track& track) {
    const auto& s = track.samples;
    return std::any_of(s.begin() + 300, s.end(),
                       [&](const Sample& later) { return glm::distance(later.position_m, s[300].position_m) > 50; });
  }));
  CHECK(mean_speed_m_s(t, 0) > 2);
  CHECK(mean_speed_m_s(t, 240) > 2);
  CHECK(mean_speed_m_s(generate_traffic(options_of(1, 20, 1)), 0) > 6);
}

TEST_CASE("vehicles keep to the right lane of their street and turn on crossings only") {
  const StreetGrid grid{3, 4, 70, 24};
  const Trajectories t = generate_traffic(options_of(11, 60, 60, 0.1, grid));
  std::set<long> yaws_deg;
  uint64_t turning = 0;
  for (const Track& track : t.tracks) {
    for (const Sample& s : track.samples) {
      const double x = off_centre_m(s.position_m.x, grid.blocks_x, grid),
                   y = off_centre_m(s.position_m.y, grid.blocks_y, grid);
      const double quarters = s.yaw_rad / (pi / 2);
      if (std::abs(quarters - std::round(quarters)) < 1e-9) {
        yaws_deg.insert(std::lround(s.yaw_rad * 180 / pi));
        CHECK(std::sin(s.yaw_rad) * x - std::cos(s.yaw_rad) * y == Approx(3).epsilon(1e-9));
      } else {
        ++turning;
        CHECK(std::abs(x) <= 12);
        CHECK(std::abs(y) <= 12);
      }
      CHECK(std::abs(s.position_m.x) <= 3 * 94 / 2.0 + 3);
      CHECK(std::abs(s.position_m.y) <= 4 * 94 / 2.0 + 3);
      CHECK(s.position_m.z == 0);
      CHECK(s.pitch_rad == 0);
    }
  }
  CHECK(yaws_deg.size() >= 4);
  CHECK(turning > 1000);
}

TEST_CASE("motion is smooth: velocities are those of the positions, brakes and turns gentle") {
  const double step_s = 0.1;
  const Trajectories t = generate_traffic(options_of(8, 200, 60, step_s));
  double fastest_m_s = 0;
  for (const Track& track : t.tracks) {
    for (size_t k = 1; k < track.samples.size(); ++k) {
      const Sample &a = track.samples[k - 1], &b = track.samples[k];
      check_near(b.position_m - a.position_m, (a.velocity_m_s + b.velocity_m_s) / 2.0 * step_s, 5e-3);
      check_near(b.velocity_m_s, b.speed_m_s * glm::dvec3(std::cos(b.yaw_rad), std::sin(b.yaw_rad), 0));
      const double change_m_s = b.speed_m_s - a.speed_m_s;
      CHECK(change_m_s <= 2 * step_s + 1e-9);
      CHECK(change_m_s >= -4 * step_s);
      // Turns have 7 m (right) and 13 m (left), with speeds of at most 2.5 m/s^2 sideways.
      CHECK(std::abs(std::remainder(b.yaw_rad - a.yaw_rad, 2 * pi)) <= 1.1 * std::sqrt(2.5 / 7) * step_s);
      CHECK(b.speed_m_s >= 0);
      fastest_m_s = std::max(fastest_m_s, b.speed_m_s);
    }
  }
  CHECK(fastest_m_s > 12);
  CHECK(fastest_m_s <= 60 / 3.6);
}

TEST_CASE("a finished drive: samples, order, types") {
  const Trajectories t = generate_traffic(options_of(1, 840, 1));
  CHECK(t.first_time_s == 0);
  CHECK(t.last_time_s == Approx(1));
  CHECK(t.step_s == Approx(0.1));
  CHECK(t.warnings.empty());
  std::map<std::string, int> count;
  std::set<std::string> ids;
  for (const Track& track : t.tracks) {
    CHECK(track.samples.size() == 11);
    CHECK(track.segments == std::vector<uint32_t>{0});
    ++count[t.types.at(track.type).name];
    ids.insert(track.id);
  }
  CHECK(ids.size() == 840);
  CHECK(ids.contains("veh0"));
  CHECK(ids.contains("veh839"));
  CHECK(std::abs(count["passenger"] / 840.0 - 0.80) < 0.04);
  CHECK(std::abs(count["delivery"] / 840.0 - 0.12) < 0.04);
  CHECK(std::abs(count["truck"] / 840.0 - 0.08) < 0.04);
  for (const VehicleType& type : t.types) CHECK(type == *sumo_type(type.name));
  CHECK(pose_at(t.tracks[0], 0.55).has_value());
}

TEST_CASE("the drive depends on its options only, and a longer one begins with the shorter one") {
  const Trajectories a = generate_traffic(options_of(1, 50, 20)), b = generate_traffic(options_of(1, 50, 10)),
                     other = generate_traffic(options_of(2, 50, 10)),
                     fewer = generate_traffic(options_of(1, 50, 10, 0.5));
  bool same = true, differs = false;
  for (size_t i = 0; i < a.tracks.size(); ++i) {
    for (size_t k = 0; k < b.tracks[i].samples.size(); ++k) {
      const Sample &p = a.tracks[i].samples[k], &q = b.tracks[i].samples[k];
      same = same && p.position_m == q.position_m && p.yaw_rad == q.yaw_rad && p.speed_m_s == q.speed_m_s;
      differs = differs || p.position_m != other.tracks[i].samples[k].position_m;
    }
    // Samples that are farther apart are of the same drive.
    CHECK(fewer.tracks[i].samples.size() == 21);
    check_near(fewer.tracks[i].samples[20].position_m, a.tracks[i].samples[100].position_m, 1e-9);
  }
  CHECK(same);
  CHECK(differs);
}

TEST_CASE("what does not fit is an error that says what does") {
  // 6 x 6 blocks have 2 * 7 * 6 stretches of street with two lanes each, of 80 m: five slots of 16 m.
  CHECK(generate_traffic(options_of(1, 2 * 7 * 6 * 2 * 5, 0.1)).tracks.size() == 840);
  CHECK_THROWS_WITH_AS(generate_traffic(options_of(1, 841, 1)),
                       Contains("841 vehicles do not fit into the streets of 6x6 blocks, at most 840 do"), ConfigError);
  CHECK_THROWS_WITH_AS(generate_traffic(options_of(1, 1, 1, 0.1, {6, 6, 80, 11})), Contains("--street-m 12 or more"),
                       ConfigError);
}

TEST_CASE("FCD that is written reads back to the same poses") {
  const Trajectories t = generate_traffic(options_of(9, 80, 10));
  const Trajectories back = read_text(format_fcd(t));
  CHECK(back.warnings.empty());
  REQUIRE(back.tracks.size() == t.tracks.size());
  CHECK(back.step_s == Approx(t.step_s));
  for (size_t i = 0; i < t.tracks.size(); ++i) {
    const Track &a = t.tracks[i], &b = back.tracks[i];
    CHECK(a.id == b.id);
    CHECK(t.types[a.type] == back.types[b.type]);
    CHECK(b.segments.size() == 1);
    REQUIRE(a.samples.size() == b.samples.size());
    for (size_t k = 0; k < a.samples.size(); ++k) {
      CHECK(b.samples[k].time_s == Approx(a.samples[k].time_s).epsilon(1e-12));
      check_near(b.samples[k].position_m, a.samples[k].position_m, 1e-5);
      check_near(b.samples[k].velocity_m_s, a.samples[k].velocity_m_s, 1e-5);
      CHECK(std::abs(std::remainder(b.samples[k].yaw_rad - a.samples[k].yaw_rad, 2 * pi)) < 1e-4 * pi / 180);
    }
  }
}

TEST_CASE("FCD of slopes, of vehicles that come later, and of ids that XML would misread") {
  const VehicleType type{"passenger", 5, 1.8, 1.5};
  const WaypointTrack tracks[] = {{"a<b>&\"c\"", type, {{0, {0, 0, 0}}, {1, {3, 0, 4}}, {2, {6, 0, 8}}}},
                                  {"late", type, {{1, {50, 0, 0}}, {2, {50, 9, 0}}, {3, {50, 18, 0}}}}};
  const Trajectories t = connect_waypoints(tracks), back = read_text(format_fcd(t));
  REQUIRE(back.tracks.size() == 2);
  for (size_t i = 0; i < 2; ++i) {
    CHECK(back.tracks[i].id == t.tracks[i].id);
    CHECK(back.tracks[i].samples.front().time_s == t.tracks[i].samples.front().time_s);
    for (size_t k = 0; k < 3; ++k) {
      check_near(back.tracks[i].samples[k].position_m, t.tracks[i].samples[k].position_m, 1e-5);
      CHECK(back.tracks[i].samples[k].pitch_rad == Approx(t.tracks[i].samples[k].pitch_rad).epsilon(1e-6));
    }
  }
}
