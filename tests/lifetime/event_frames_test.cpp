// SPDX-License-Identifier: Apache-2.0
// Births and deaths of paths among twenty vehicles and boxes, compared with frames of much smaller steps.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "jobs/path_events.hpp"
#include "passes/triangles.hpp"
#include "simulation/buildings.hpp"
#include "simulation/drive.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::vector<Part> boxes() {
  std::vector<Part> out = street();
  Random random(3);
  for (int k = 0; k < 5; ++k)
    out.push_back({building({-50 + 22 * k, 9.5, 0}, random.between(-0.2, 0.2), 6, 2, random.between(2, 5)), "brick"});
  return out;
}

// Twenty cars and lorries in four lanes, each with an antenna that hears the one at the street.
Config traffic(const SceneFile& file, uint32_t max_depth) {
  Config config = config_of(file.path(), {{-5.3, 12.17, 4.1}}, {}, 1000, max_depth);
  config.trace.discovery = "beams";
  config.output.lifetimes = true;
  std::vector<Straight> vehicles;
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const double lane = std::array{-8.1, -4.3, 1.2, 5.4}[k % 4], way = k % 4 < 2 ? 1 : -1;
    vehicles.push_back({fmt::format("v{}", k),
                        k % 5 == 4 ? "truck" : "passenger",
                        {-48 + 20 * (k / 4) + random.between(-3, 3), lane + random.between(-0.3, 0.3), 0},
                        {way * random.between(6, 14), random.between(-0.3, 0.3), 0},
                        0,
                        2});
  }
  add_vehicles(config, vehicles, 0.1);
  config.mounts = {{.name = "roof", .on = "*", .role = "receiver", .offset_m = {0.3, 0, 3.9}}};
  return config;
}

using Event = std::tuple<Link, Touched, bool>;  // true: a birth

std::set<std::pair<Link, Touched>> all_paths(const LinksAtTime& links) {
  std::set<std::pair<Link, Touched>> out;
  for (const auto& [link, paths] : links)
    for (const auto& [path, lifetime_m] : paths) out.insert({link, path});
  return out;
}

}  // namespace

TEST_CASE("events of twenty vehicles are those of frames with 64 times smaller steps, to a thousandth of a step") {
  const SceneFile file(boxes());
  Simulation simulation(traffic(file, 3));
  const EventDrive drive = drive_of(simulation);
  constexpr int fine = 64;
  constexpr uint32_t parts = 8;
  constexpr int steps = 2;
  std::vector<double> times;
  for (uint32_t frame = 4; frame <= 4 + steps; ++frame) times.push_back(simulation.time_s(frame));
  const double step_s = times[1] - times[0], piece_s = step_s / fine;
  const EventList found = find_events(drive, times, {.precision = 1e-3, .parts = parts});

  std::vector<std::set<std::pair<Link, Touched>>> there;
  for (int k = 0; k <= steps * fine; ++k)
    there.push_back(all_paths(drive.paths(std::min(times[0] + k * piece_s, times.back()), nullptr)));
  // A path may be missed only if it is not there, or there, at all of the times that were computed for its link.
  const auto lasts = [&](const std::pair<Link, Touched>& path, int from, int way) {
    const bool now = there[from].contains(path);
    int k = from;
    while (k >= 0 && k <= steps * fine && there[k].contains(path) == now) k += way;
    return std::abs(k - from);
  };
  size_t expected = 0, missed = 0, brief = 0;
  for (int k = 0; k < steps * fine; ++k)
    for (const bool birth : {true, false})
      for (const auto& path : there[k + birth]) {
        if (there[k + 1 - birth].contains(path)) continue;
        ++expected;
        const double low = times[0] + k * piece_s - 1e-3 * step_s, high = low + piece_s + 2e-3 * step_s;
        const bool is_found = std::ranges::any_of(found.events, [&](const PathEvent& event) {
          return event.link == path.first && event.path == path.second && event.birth == birth && event.time_s >= low &&
                 event.time_s <= high;
        });
        if (is_found) continue;
        const bool is_brief = std::min(lasts(path, k, -1), lasts(path, k + 1, 1)) <= fine / int(parts);
        (is_brief ? brief : missed) += 1;
      }
  MESSAGE(expected, " events between small steps, ", found.events.size(), " found, ", brief, " of brief paths missed, ",
          found.instants, " times computed, ", found.unsure, " unsure");
  CHECK(expected > 60);
  CHECK(missed == 0);
  CHECK(brief <= expected / 20);
  // The path is there on one side of its event and not on the other, half of the precision away.
  for (size_t k = 0; k < found.events.size(); k += 5) {
    const PathEvent& event = found.events[k];
    const std::vector<Link> only{event.link};
    CAPTURE(k);
    for (const bool after : {false, true}) {
      const double time_s = event.time_s + (after ? 0.5 : -0.5) * 1e-3 * step_s;
      CHECK(all_paths(drive.paths(time_s, &only)).contains({event.link, event.path}) == (after == event.birth));
    }
  }
}

TEST_CASE("times outside of the drive, and drives by rays, have no events") {
  const SceneFile file(boxes());
  Config config = traffic(file, 1);
  Simulation simulation(config);
  CHECK_THROWS_AS(simulation.run_time(-1, nullptr), ConfigError);
  CHECK_THROWS_AS(simulation.run_time(1e9, nullptr), ConfigError);
  config.trace.discovery = "rays";
  CHECK_THROWS_AS(Simulation(config).run_time(0, nullptr), ConfigError);
}

TEST_CASE("an instant is the frame at its time, and a link alone has its paths") {
  const SceneFile file(boxes());
  Simulation simulation(traffic(file, 2));
  const Paths frame = simulation.run_frame(3).paths, instant = simulation.run_time(simulation.time_s(3)).paths;
  CHECK(frame.delay_s == instant.delay_s);
  CHECK(frame.lifetime_m == instant.lifetime_m);
  const std::vector<Link> only{{0, 5}, {0, 11}};
  const Paths some = simulation.run_time(simulation.time_s(3), &only).paths;
  size_t expected = 0;
  for (const uint32_t rx : frame.rx) expected += rx == 5 || rx == 11;
  CHECK(expected > 0);
  CHECK(some.size() == expected);
}

TEST_CASE("the motion between two times bounds that of all points at all times between") {
  const SceneFile file(boxes());
  Config config = traffic(file, 1);
  config.tracks.push_back({"turns", "truck", {{0, -20, -3, 0}, {0.6, -12, -2, 0}, {1, -10, 3, 0}, {1.5, -14, 6, 0}}});
  Simulation simulation(config);
  const auto corners = [&](double time_s) {
    const WorldState state = simulation.run_time(time_s).world;
    std::vector<glm::dvec3> out;
    for (size_t i = 0; i < state.instances.size(); ++i)
      for (const glm::dvec3& p : simulation.models()[simulation.instances()[i].model].vertices)
        out.push_back(state.instances[i].position_m + state.instances[i].rotation * p);
    for (size_t i = 0; i < state.receivers.size(); ++i) out.push_back(state.receivers[i].position_m);
    return out;
  };
  for (const auto& [from, to] : {std::pair{0.1, 0.3}, {0.5, 0.9}, {0.9, 0.5}, {1.4, 0.2}, {1.1, 1.1}}) {
    CAPTURE(from);
    CAPTURE(to);
    const std::vector<glm::dvec3> first = corners(from);
    double farthest = 0;
    for (int k = 0; k <= 12; ++k) {
      const std::vector<glm::dvec3> now = corners(from + k * (to - from) / 12);
      for (size_t i = 0; i < now.size(); ++i) farthest = std::max(farthest, glm::distance(now[i], first[i]));
    }
    const double bound = simulation.motion_m(from, to);
    CHECK(bound >= farthest - 1e-9);
    CHECK(bound <= 4 * farthest + 1e-9);
  }
  CHECK(std::isinf(simulation.motion_m(1.4, 1.6)));  // the truck that turns vanishes
}
