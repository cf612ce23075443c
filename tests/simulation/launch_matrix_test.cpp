// SPDX-License-Identifier: Apache-2.0
// Tests every option that decides what rays find, with every kind of links: the paths must be those of a plain launch
// of ten times the rays. Scenes and rays are chosen such that a plain launch finds all paths. Only options that are
// documented to lose paths may do so.
#include <functional>
#include <span>
#include <utility>

#include "simulation/drive.hpp"
#include "wavetracer/live.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint64_t rays = 10000;
constexpr uint32_t last_frame = 3;
constexpr double step_s = 0.5;
const std::vector<Straight> in_city{{"a", "passenger", {-40.2, -3.1, 0}, {11.3, 0.02, 0}, 0, 1.5},
                                    {"b", "passenger", {2.9, 42.3, 0}, {0.01, -9.1, 0}, 0, 1.5},
                                    {"c", "passenger", {33.1, 3.3, 0}, {-8.7, -0.03, 0}, 1, 1.5}};
const std::vector<Straight> in_street{{"a", "passenger", {-20.3, -3.1, 0}, {9.7, 0.4, 0}, 0, 1.5},
                                      {"b", "passenger", {30.7, 3.9, 0}, {-11.3, 0.3, 0}, 0, 1.5},
                                      {"c", "passenger", {19.6, 7.1, 0}, {-7.9, -0.7, 0}, 1, 1.5}};

// A world with links of one kind.
struct Links {
  std::string name;
  bool city;      // with cars that reflect; or a street of many reflections, whose vehicles are antennas alone
  bool listener;  // is there an end that only receives?
  LinksConfig links;
};

const Links all_links[] = {
    {"city, all, one end only receives", true, true, {}},
    {"city, by distance", true, false, {.max_distance_m = 45}},
    {"street, both ways", false, false, {}},
    {"street, from one vehicle", false, false, {.transmitters = {"a/m"}}},
    {"street, from one to another", false, false, {.transmitters = {"a/m"}, .receivers = {"b/m"}}},
    {"street, by distance", false, true, {.max_distance_m = 35}}};

Config config_with(const Links& links, const std::filesystem::path& street_file) {
  const glm::dvec3 both = links.city ? glm::dvec3{3, 5, 6} : glm::dvec3{-31.3, 2.17, 4.1};
  const glm::dvec3 listener = links.city ? glm::dvec3{-46, 4, 1.5} : glm::dvec3{27.1, 5.21, 1.9};
  Config config = config_of(links.city ? "" : street_file, {both}, {both, listener}, rays, links.city ? 3 : 5);
  if (!links.listener) config.receivers.pop_back();
  if (links.city) config.scene.generate = "--blocks 2x2";
  add_vehicles(config, links.city ? in_city : in_street, step_s);
  if (!links.city) config.vehicle_types = {{.name = "passenger", .model = "none"}};
  config.mounts = {{.name = "m", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  config.links = links.links;
  config.trace.reuse = false;
  return config;
}

// Appends the columns that tell paths apart.
void add(const Paths& more, Paths& all) {
  for (size_t i = 0; i < more.size(); ++i) {
    all.tx.push_back(more.tx[i]);
    all.rx.push_back(more.rx[i]);
    all.depth.push_back(more.depth[i]);
    all.delay_s.push_back(more.delay_s[i]);
    for (size_t k = more.vertex_offset[i]; k < more.vertex_offset[i + 1]; ++k)
      all.vertex_position_m.push_back(more.vertex_position_m[k]);
    all.vertex_offset.push_back(all.vertex_position_m.size());
  }
}

// Ways to the last frame of the drive.
Paths alone(const Config& config) {
  Simulation simulation(config);
  return simulation.run_frame(config.tracks.empty() ? 0 : last_frame).paths;
}

Paths drive(const Config& config) {
  Simulation simulation(config);
  for (uint32_t frame = 0; frame < last_frame; ++frame) simulation.run_frame(frame);
  return simulation.run_frame(last_frame).paths;
}

Paths second_of_a_shard(const Config& config) {
  Simulation simulation(config);
  simulation.run_frame(0);
  simulation.forget();
  simulation.run_frame(last_frame - 1);
  return simulation.run_frame(last_frame).paths;
}

Paths blocks(const Config& config) {
  Simulation simulation(config);
  Paths found;
  for (uint32_t tx = 0; tx < simulation.config().transmitters.size(); ++tx)
    add(simulation.run_block(last_frame, {tx, tx + 1}).paths, found);
  return found;
}

// Sends the poses of the drive as a client whose names are those of places; cold: each frame forgets earlier ones.
Paths live(Config config, bool cold) {
  config.tracks.clear();
  const std::vector<Straight>& cars = config.scene.generate.empty() ? in_street : in_city;
  config.live_vehicles = {{"passenger", 3}};
  for (std::vector<std::string>* names : {&config.links.transmitters, &config.links.receivers})
    for (std::string& name : *names)
      for (const auto& [id, place] : {std::pair{"a/m", "passenger.0/m"}, {"b/m", "passenger.1/m"}})
        if (name == id) name = place;
  Simulation simulation(config);
  LiveTraffic traffic;
  Paths found;
  for (uint32_t frame = 0; frame <= last_frame; ++frame) {
    const double time_s = step_s * frame;
    std::vector<LivePose> poses;
    for (const Straight& car : cars) {
      if (time_s < car.start_s) continue;
      poses.emplace_back().id = car.id;
      poses.back().type = car.type;
      poses.back().position_m = car.at(time_s);
      poses.back().orientation =
          glm::angleAxis(std::atan2(car.velocity_m_s.y, car.velocity_m_s.x), glm::dvec3{0, 0, 1});
    }
    if (cold) simulation.forget();
    found = simulation.run_poses(traffic, time_s, poses).result.paths;
  }
  return found;
}
Paths live_cold(const Config& config) { return live(config, true); }
Paths live_warm(const Config& config) { return live(config, false); }

struct Option {
  std::string name;
  std::function<void(Config&)> set;
  std::function<Paths(const Config&)> run = alone;
};

void reuse(Config& config) { config.trace.reuse = true; }
void automatic(Config& config) { config.trace.rays = {}; }
void exact_cache(Config& config) { config.cache = {.kind = "concurrent", .key = "exact"}; }

const Option options[] = {
    {"plain", [](Config&) {}},
    {"batch_rays", [](Config& c) { c.trace.batch_rays = 3000; }},
    {"order", [](Config& c) { c.order = {.method = "H3DH", .each_depth = true}; }},
    {"directions", [](Config& c) { c.trace.directions = "fibonacci"; }},
    {"auto", automatic},
    {"reuse", reuse, drive},
    {"reuse, auto", [](Config& c) { reuse(c), automatic(c); }, drive},
    {"refresh_rays, forget_frames",
     [](Config& c) { reuse(c), c.trace.refresh_rays = rays / 5, c.trace.forget_frames = 2; }, drive},
    {"--frames", reuse},
    {"shards", reuse, second_of_a_shard},
    {"blocks of transmitters", reuse, blocks},
    {"live", reuse, live_warm},
    {"live, cold", reuse, live_cold},
    {"live, cold, auto", [](Config& c) { reuse(c), automatic(c); }, live_cold},
    {"exact cache", exact_cache, drive},
    {"first_depth", [](Config& c) { exact_cache(c), c.cache.first_depth = 2; }, drive},
};

// These options are documented to find fewer paths, but never wrong ones.
const Option losing[] = {
    {"max_rays", [](Config& c) { automatic(c), c.trace.max_rays = 500; }},
    {"cache scope all", [](Config& c) { c.cache = {.kind = "concurrent", .scope = "all"}; }, drive},
    {"random directions", [](Config& c) { c.trace.directions = "random"; }},
    {"few rays", [](Config& c) { c.trace.rays = 2000; }},
};

}  // namespace

TEST_CASE("every option finds what a plain launch of ten times the rays does, whatever the links") {
  const SceneFile file(street());
  for (const Links& links : all_links) {
    Config config = config_with(links, file.path());
    config.trace.rays = 10 * rays;
    const Paths expected = alone(config);
    CAPTURE(links.name);
    CHECK(expected.size() > 5);
    config.trace.rays = rays;
    for (const auto& [list, loses] :
         {std::pair{std::span<const Option>(options), false}, {std::span<const Option>(losing), true}})
      for (const Option& option : list) {
        Config changed = config;
        option.set(changed);
        const Paths found = option.run(changed);
        CAPTURE(option.name);
        CAPTURE(expected.size());
        CAPTURE(found.size());
        CHECK(missing(found, expected) == 0);
        if (!loses) CHECK(missing(expected, found) == 0);
      }
  }
}

TEST_CASE("diffraction_rays: of ends that only receive; few of them find less, and nothing that is none") {
  const SceneFile file(street());
  const Points ends{{-31.3, 2.17, 4.1}, {27.1, 5.21, 1.9}}, listeners{{12.4, -7.3, 0.9}, {-8.7, 9.4, 1.3}};
  const auto found_with = [&](const Points& receivers, uint64_t a_transmitter, uint64_t a_listener) {
    Config config = config_of(file.path(), ends, receivers, a_transmitter, 2);
    config.trace.diffraction = true;
    config.trace.diffraction_rays = a_listener;
    return alone(config);
  };
  const Paths expected = found_with(listeners, 10 * rays, 10 * rays);
  const Paths many = found_with(listeners, rays, rays), few = found_with(listeners, rays, 10);
  REQUIRE(expected.size() > 250);
  CHECK(missing(many, expected) == 0);
  CHECK(missing(few, expected) == 0);
  CHECK(50 * missing(expected, many) <= expected.size());
  CHECK(10 * missing(expected, few) > expected.size());
  // If all ends transmit, there is no listener.
  CHECK(identical(found_with(ends, rays, rays), found_with(ends, rays, 50)));
}
