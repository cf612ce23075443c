// SPDX-License-Identifier: Apache-2.0
// Tests worlds in which there is nothing to do, with each feature on: no ends, one vehicle alone, no link, nothing to
// hit. Such frames come first and full ones then, and the other way round; in drives, blocks, fixed worlds and live
// worlds. Where frames reuse nothing, a full frame is the same whatever frames came before it.
#include <functional>
#include <map>

#include "simulation/drive.hpp"
#include "wavetracer/live.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Variant {
  const char* name;
  std::function<void(Config&)> set;
};

void cached(Config& config, const char* kind) {
  config.cache.kind = CacheKind::named(kind);
  config.cache.buffer_size = 1 << 14;
}

void by_spheres(Config& config) {
  config.trace.reception = "sphere";
  config.trace.sphere_radius_m = 2;
}

void by_everything(Config& config) {
  config.trace.diffraction = config.trace.transmission = config.trace.scattering = true;
  config.trace.max_diffractions = 2;
}

// The options that a frame may have, alone or together.
std::vector<Variant> variants() {
  return {
      {"reflection", [](Config&) {}},
      {"nothing", [](Config& c) { c.trace.reflection = false; }},
      {"no depth", [](Config& c) { c.trace.max_depth = 0; }},
      {"one diffraction", [](Config& c) { c.trace.diffraction = true; }},
      {"two diffractions", [](Config& c) { c.trace.diffraction = true, c.trace.max_diffractions = 2; }},
      {"transmission", [](Config& c) { c.trace.transmission = true; }},
      {"scattering", [](Config& c) { c.trace.scattering = true; }},
      {"scattering and transmission", [](Config& c) { c.trace.scattering = c.trace.transmission = true; }},
      {"walls alone scatter", [](Config& c) { c.trace.scattering = true, c.materials[1].scattering = 0; }},
      {"leaves alone scatter", [](Config& c) { c.trace.scattering = true, c.materials[0].scattering = 0; }},
      {"nothing scatters",
       [](Config& c) { c.trace.scattering = true, c.materials[0].scattering = c.materials[1].scattering = 0; }},
      {"no vegetation", [](Config& c) { c.trace.scattering = true, c.vegetation.clear(); }},
      {"all", by_everything},
      {"all, auto", [](Config& c) { by_everything(c), c.trace.rays = {}, c.trace.max_rays = 20000; }},
      {"auto", [](Config& c) { c.trace.rays = {}, c.trace.max_rays = 20000; }},
      {"batches", [](Config& c) { by_everything(c), c.trace.batch_receivers = 1; }},
      {"carriers",
       [](Config& c) {
         by_everything(c), c.radio.frequencies_hz = {5.9e9, 28e9};
       }},
      {"responses", [](Config& c) { c.response.bandwidth_hz = 20e6; }},
      {"spheres", by_spheres},
      {"waypoints", [](Config& c) { c.output.waypoints = 7; }},
      {"spheres and waypoints", [](Config& c) { by_spheres(c), c.output.waypoints = 7; }},
      {"chained", [](Config& c) { cached(c, "chained"); }},
      {"open", [](Config& c) { cached(c, "open"); }},
      {"concurrent", [](Config& c) { cached(c, "concurrent"), c.cache.innerframe = true; }},
      {"thesis", [](Config& c) { cached(c, "thesis"); }},
      {"thesis-chained", [](Config& c) { cached(c, "thesis-chained"); }},
      {"cached entries", [](Config& c) { cached(c, "open"), c.cache.statistics = c.output.cache_entries = true; }},
      {"cached spheres", [](Config& c) { by_spheres(c), cached(c, "open"), c.cache.scope = "all"; }},
      {"order", [](Config& c) { c.order = {.method = "hilbert3d-histogram", .each_depth = true}; }},
      {"discoveries apart", [](Config& c) { c.trace.discover_every_s = 2; }},
  };
}

// Threads fill such tables in any order, so another run may find other paths.
bool varies(const Config& config) { return config.cache.on(); }

// Two walls, the ground, a house with edges, a crown; all of them scatter.
Config place_of(const std::string& scene) {
  Config config = config_of(scene, {}, {}, 1000, 2);
  config.materials.resize(2);
  config.materials[0].name = "brick";
  config.materials[0].scattering = 0.3;
  config.materials[1].name = "vegetation";
  config.materials[1].vegetation = "mixed";
  config.materials[1].scattering = 0.5;
  config.vegetation.resize(1);
  config.vegetation[0].centre_m = {0, 5, 5};
  config.vegetation[0].size_m = {4, 4, 6};
  config.trace.diffraction_rays = 500;
  config.links.max_distance_m = 60;
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  return config;
}

std::vector<Part> walls() {
  return {{{{{-30, -12, 0}, {60, 0, 0}, {0, 24, 0}}}, "concrete"},
          {{{{-30, 12, 0}, {60, 0, 0}, {0, 0, 9}}}, "brick"},
          {reference::box_walls({-4, -11, 0}, {5, -7, 6}), "glass"}};
}

// Frame 0: no ends; 1: a alone; 2: both, too far apart; 3: together, high above everything; 4 and 5: in the street;
// then the same backwards.
constexpr uint32_t frame_count = 9;
bool has_links(uint32_t frame) { return frame >= 3 && frame <= 5; }
bool in_street(uint32_t frame) { return frame == 4 || frame == 5; }
Config drive_of(const std::string& scene) {
  Config config = place_of(scene);
  config.vehicle_types = vehicle_types();
  config.tracks = {
      {"a",
       "passenger",
       {{1, -12, 1, 0},
        {2, -12, 1, 0},
        {3, 0, 0, 2000},
        {4, -12, 1, 0},
        {5, -11, 1, 0},
        {6, -12, 1, 0},
        {7, -12, 1, 0}}},
      {"b", "passenger", {{2, 900, 0, 0}, {3, 20, 3, 2000}, {4, 12, 3, 0}, {5, 11, 3, 0}, {6, 900, 0, 0}}}};
  config.time = {0, 8, 1};
  return config;
}

void check_counts(const FrameResult& frame, uint32_t number, const Config& config) {
  CAPTURE(number);
  CHECK(frame.world.links.size() == (has_links(number) ? 2 : 0));
  if (!has_links(number)) CHECK(frame.paths.size() == 0);
  if (number == 3 && !config.trace.by_spheres()) CHECK(frame.paths.size() >= 2);  // perhaps a reflection at the ground
  if (in_street(number)) CHECK(frame.paths.size() >= 2);
}

// Computes the frames in this order; each number occurs once. give_back: their memory is used again.
std::map<uint32_t, FrameResult> frames_of(Simulation& simulation, const std::vector<uint32_t>& order,
                                          bool give_back = false) {
  REQUIRE(simulation.frame_count() == frame_count);
  std::map<uint32_t, FrameResult> out;
  for (const uint32_t number : order) {
    FrameResult frame = simulation.run_frame(number);
    check_counts(frame, number, simulation.config());
    out.emplace(number, frame);
    if (give_back) {
      simulation.give_back(frame);
      CHECK(frame.paths.size() == 0);
    }
  }
  REQUIRE(out.size() == frame_count);
  return out;
}

const std::vector<uint32_t> empty_first{0, 1, 2, 3, 4, 5, 6, 7, 8}, full_first{4, 3, 2, 1, 0, 5, 8, 7, 6};

// Checks blocks of one transmitter, of no transmitter and of all.
void check_blocks(Simulation& simulation, const std::map<uint32_t, FrameResult>& whole) {
  if (!block_obstacle(simulation.config()).empty()) return;
  for (const uint32_t number : {0u, 2u, 4u, 1u}) {
    CAPTURE(number);
    CHECK(simulation.run_block(number, {1, 1}).paths.size() == 0);
    const size_t first = simulation.run_block(number, {0, 1}).paths.size();
    CHECK(first + simulation.run_block(number, {1, no_end}).paths.size() == whole.at(number).paths.size());
  }
}

LivePose pose(const char* id, const glm::dvec3& position_m) {
  return {.id = id, .type = "passenger", .position_m = position_m, .velocity_m_s = {}, .angular_velocity_rad_s = {}};
}

}  // namespace

TEST_CASE("drives whose frames are empty at first, and at last, with each feature on") {
  const SceneFile file(walls());
  for (const Variant& variant : variants()) {
    CAPTURE(variant.name);
    Config config = drive_of(file.path().string());
    variant.set(config);
    {
      Simulation reusing(config);
      frames_of(reusing, empty_first);
    }
    config.trace.reuse = false;
    config.trace.discover_every_s = 0;
    Simulation before(config), after(config);
    const std::map<uint32_t, FrameResult> whole = frames_of(before, empty_first),
                                          again = frames_of(after, full_first, true);
    if (!varies(config))
      for (const auto& [number, frame] : whole) {
        CHECK(identical(frame.paths, again.at(number).paths));
        CHECK(frame.paths.quarters == again.at(number).paths.quarters);
        CHECK(frame.paths.group == again.at(number).paths.group);
        CHECK(frame.paths.group_weight == again.at(number).paths.group_weight);
      }
    check_blocks(after, whole);
  }
}

TEST_CASE("worlds without vehicles and without a link, with each feature on") {
  const SceneFile file(walls());
  for (const Variant& variant : variants()) {
    CAPTURE(variant.name);
    Config config = place_of(file.path().string());
    config.transmitters = config_of("", {{-12, 1, 3}}, {}, 1, 1).transmitters;
    config.receivers = config_of("", {}, {{12, 3, 2}, {11, 2, 2}}, 1, 1).receivers;
    config.mounts.clear();
    config.links.max_distance_m = 1;
    variant.set(config);
    Simulation simulation(config);
    for (int time = 0; time < 2; ++time) {
      const FrameResult frame = simulation.run_frame(0);
      CHECK(frame.world.links.empty());
      CHECK(frame.paths.size() == 0);
      if (block_obstacle(config).empty()) CHECK(simulation.run_block(0, {0, 1}).paths.size() == 0);
    }
  }
}

TEST_CASE("live worlds that are empty at first, between, and at last, with each feature on") {
  const SceneFile file(walls());
  const std::vector<LivePose> nobody, alone{pose("a", {-12, 1, 0})},
      apart{pose("a", {-12, 1, 0}), pose("b", {90, 0, 0})}, together{pose("a", {-12, 1, 0}), pose("b", {12, 3, 0})};
  for (const Variant& variant : variants()) {
    CAPTURE(variant.name);
    Config config = place_of(file.path().string());
    config.live_vehicles = {{"passenger", 3}};
    variant.set(config);
    config.response = {};
    Simulation simulation(config);
    LiveTraffic traffic;
    double time_s = 0;
    for (const auto* poses : {&nobody, &alone, &apart, &together, &nobody, &together, &apart}) {
      CAPTURE(time_s);
      const LiveFrame frame = simulation.run_poses(traffic, time_s, *poses);
      CHECK(frame.result.world.links.size() == (poses == &together ? 2 : 0));
      CHECK((frame.result.paths.size() > 0) == (poses == &together));
      if (time_s > 0) CHECK_NOTHROW(simulation.run_between(traffic, time_s - 0.5));
      time_s += 1;
    }
  }
}
