// Every option that decides what rays find, with every kind of links: the paths of a plain launch of ten times the rays.
// A city, cars that reflect, and rays enough that a plain launch finds all there is; what an option is documented to
// lose, it loses here.
#include <functional>
#include <set>
#include <tuple>
#include <utility>

#include "simulation/drive.hpp"
#include "wavetracer/live.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint64_t rays = 40000;
constexpr uint32_t last_frame = 3;
constexpr double step_s = 0.5;
const std::vector<Straight> vehicles{{"a", "passenger", {-40.2, -3.1, 0}, {11.3, 0.02, 0}, 0, 1.5},
                                     {"b", "passenger", {2.9, 42.3, 0}, {0.01, -9.1, 0}, 0, 1.5},
                                     {"c", "passenger", {33.1, 3.3, 0}, {-8.7, -0.03, 0}, 1, 1.5}};

struct Links {
  std::string name;
  LinksConfig links;
  bool both_ways;  // is there a link the other way to each?
};

const Links all_links[] = {{"all", {}, false},
                           {"vehicles both ways", {.transmitters = {"*/m"}, .receivers = {"*/m"}}, true},
                           {"one vehicle to all", {.transmitters = {"a/m"}}, false},
                           {"one vehicle to the other", {.transmitters = {"a/m"}, .receivers = {"b/m"}}, false},
                           {"all to one vehicle", {.receivers = {"b/m"}}, false},
                           {"by distance", {.max_distance_m = 60}, false},
                           {"vehicles to standing ones alone", {.v2v = false}, false}};

Config city(const LinksConfig& links) {
  Config config = config_of("", {{3, 5, 6}}, {{3, 5, 6}, {-46, 4, 1.5}}, rays, 3);
  config.receivers[0].name = "tx0 again";  // where tx0 sends from
  config.scene.generate = "--blocks 2x2";
  add_vehicles(config, vehicles, step_s);
  config.mounts = {{.name = "m", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  config.links = links;
  config.trace.reuse = false;
  return config;
}

// A path by its ends and what it meets; a frame by its paths.
using Step = std::tuple<uint8_t, uint32_t, uint32_t>;  // interaction, surface, instance
using Found = std::set<std::tuple<uint32_t, uint32_t, std::vector<Step>>>;

void add(const Paths& paths, Found& found) {
  for (size_t i = 0; i < paths.size(); ++i) {
    std::vector<Step> steps;
    for (size_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
      steps.emplace_back(paths.vertex_interaction[k], paths.vertex_surface[k], paths.vertex_instance[k]);
    CHECK(found.emplace(paths.tx[i], paths.rx[i], steps).second);
  }
}

Found found_by(Simulation& simulation, uint32_t frame) {
  Found found;
  add(simulation.run_frame(frame).paths, found);
  return found;
}

// Ways to the last frame of the drive.
Found alone(const Config& config) {
  Simulation simulation(config);
  return found_by(simulation, last_frame);
}

Found drive(const Config& config) {
  Simulation simulation(config);
  for (uint32_t frame = 0; frame < last_frame; ++frame) simulation.run_frame(frame);
  return found_by(simulation, last_frame);
}

Found second_of_a_shard(const Config& config) {
  Simulation simulation(config);
  simulation.run_frame(0);
  simulation.forget();
  simulation.run_frame(last_frame - 1);
  return found_by(simulation, last_frame);
}

Found blocks(const Config& config) {
  Simulation simulation(config);
  Found found;
  for (uint32_t tx = 0; tx < simulation.config().transmitters.size(); ++tx)
    add(simulation.run_block(last_frame, {tx, tx + 1}).paths, found);
  return found;
}

// The poses of the drive, sent by a client whose names are those of places; cold: each frame forgets.
Found live(Config config, bool cold) {
  const std::vector<Straight> cars = std::exchange(config.tracks, {}).empty() ? std::vector<Straight>{} : vehicles;
  config.live_vehicles = {{"passenger", 3}};
  for (std::vector<std::string>* names : {&config.links.transmitters, &config.links.receivers})
    for (std::string& name : *names)
      for (const auto& [id, place] : {std::pair{"a/m", "passenger.0/m"}, {"b/m", "passenger.1/m"}})
        if (name == id) name = place;
  Simulation simulation(config);
  LiveTraffic traffic;
  Found found;
  for (uint32_t frame = 0; frame <= last_frame; ++frame) {
    const double time_s = step_s * frame;
    std::vector<LivePose> poses;
    for (const Straight& car : cars) {
      if (time_s < car.start_s) continue;
      poses.emplace_back().id = car.id;
      poses.back().type = car.type;
      poses.back().position_m = car.at(time_s);
      poses.back().orientation = glm::angleAxis(std::atan2(car.velocity_m_s.y, car.velocity_m_s.x), glm::dvec3{0, 0, 1});
    }
    if (cold) simulation.forget();
    const LiveFrame result = simulation.run_poses(traffic, time_s, poses);
    found.clear();
    add(result.result.paths, found);
  }
  return found;
}
Found live_cold(const Config& config) { return live(config, true); }
Found live_warm(const Config& config) { return live(config, false); }

struct Option {
  std::string name;
  std::function<void(Config&)> set;
  std::function<Found(const Config&)> run = alone;
};

void reuse(Config& config) { config.trace.reuse = true; }
void automatic(Config& config) { config.trace.rays = 0; }
void join(Config& config) { config.trace.join = true; }
void exact_cache(Config& config) { config.cache = {.kind = "concurrent", .key = "exact"}; }

const Option options[] = {
    {"plain", [](Config&) {}},
    {"batch_rays", [](Config& c) { c.trace.batch_rays = 3000; }},
    {"order", [](Config& c) { c.order = {.method = "H3DH", .each_depth = true}; }},
    {"directions", [](Config& c) { c.trace.directions = "fibonacci"; }},
    {"auto", automatic},
    {"reuse", reuse, drive},
    {"reuse, auto", [](Config& c) { reuse(c), automatic(c); }, drive},
    {"refresh_rays, forget_frames", [](Config& c) { reuse(c), c.trace.refresh_rays = rays / 5, c.trace.forget_frames = 2; },
     drive},
    {"--frames", reuse},
    {"shards", reuse, second_of_a_shard},
    {"blocks of transmitters", reuse, blocks},
    {"live", reuse, live_warm},
    {"live, cold", reuse, live_cold},
    {"live, cold, auto", [](Config& c) { reuse(c), automatic(c); }, live_cold},
    {"exact cache", exact_cache, drive},
    {"first_depth", [](Config& c) { exact_cache(c), c.cache.first_depth = 2; }, drive},
    {"join", join},
    {"join, auto", [](Config& c) { join(c), automatic(c); }},
    {"join, reuse", [](Config& c) { join(c), reuse(c); }, drive},
    {"join, blocks", join, blocks},
    {"join, live", [](Config& c) { join(c), reuse(c); }, live_warm},
};

// Documented to find less: never what is none.
const Option losing[] = {
    {"max_rays", [](Config& c) { automatic(c), c.trace.max_rays = 500; }},
    {"cache scope all", [](Config& c) { c.cache = {.kind = "concurrent", .scope = "all"}; }, drive},
    {"random directions", [](Config& c) { c.trace.directions = "random"; }},
    {"few rays", [](Config& c) { c.trace.rays = 2000; }},
};

size_t count_missing(const Found& wanted, const Found& found) {
  size_t count = 0;
  for (const auto& path : wanted) count += !found.contains(path);
  return count;
}

}  // namespace

TEST_CASE("every option finds what a plain launch of ten times the rays does, whatever the links") {
  for (const Links& links : all_links) {
    Config config = city(links.links);
    config.trace.rays = 10 * rays;
    const Found expected = alone(config);
    CAPTURE(links.name);
    MESSAGE(links.name << ": " << expected.size());
    CHECK(expected.size() > 10);
    config.trace.rays = rays;
    for (const Option& option : options) {
      Config changed = config;
      option.set(changed);
      const Found found = option.run(changed);
      MESSAGE(links.name << " | " << option.name << " | " << expected.size() << " | " << found.size());
      CAPTURE(option.name);
      CHECK(count_missing(expected, found) == 0);
      CHECK(count_missing(found, expected) == 0);
    }
    for (const Option& option : losing) {
      Config changed = config;
      option.set(changed);
      const Found found = option.run(changed);
      MESSAGE(links.name << " | " << option.name << " | " << expected.size() << " | " << found.size());
      CAPTURE(option.name);
      CHECK(count_missing(found, expected) == 0);
    }
  }
}
