// SPDX-License-Identifier: Apache-2.0
// Tests vehicles that come and go, with every way of launching: each frame has the paths of a plain launch of its own
// that starts cold. Street and rays are chosen such that every launch finds all paths: vehicles are antennas without
// bodies, and walls are large.
#include <functional>

#include "passes/triangles.hpp"
#include "simulation/drive.hpp"
#include "wavetracer/live.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t frame_count = 12;

// Returns the number of vehicles in each frame: one at first, then numbers that often differ by a factor of four, as
// levels of a refined launch do.
std::vector<size_t> random_counts(Random& random) {
  std::vector<size_t> counts{1};
  while (counts.size() < frame_count) counts.push_back(size_t{1} << random.below(4));
  return counts;
}

// Makes vehicles arrive and leave at random, each once.
Config traffic(const std::filesystem::path& scene, uint32_t seed, uint64_t rays) {
  Random random(seed);
  const std::vector<size_t> counts = random_counts(random);
  Config config = config_of(scene, {}, {{27.1, 5.21, 1.9}}, rays, 2);
  config.vehicle_types = {{.name = "antenna", .model = "none", .length_m = 4, .width_m = 2, .height_m = 1}};
  config.time.step_s = 1;
  config.mounts = {{.name = "roof", .on = "antenna", .role = "both", .offset_m = {0, 0, 1.7}}};
  std::vector<TrackConfig> there;
  const auto leave = [&](double time_s) {
    const auto at = there.begin() + random.below(static_cast<uint32_t>(there.size()));
    const auto [from_s, x, y, z] = at->waypoints.front();
    at->waypoints.push_back({time_s, x + 0.7 * (time_s - from_s), y, z});
    config.tracks.push_back(*at);
    there.erase(at);
  };
  for (uint32_t frame = 0; frame < frame_count; ++frame) {
    while (there.size() > counts[frame]) leave(frame - 0.5);
    while (there.size() < counts[frame]) {
      const size_t number = config.tracks.size() + there.size();
      const double x = random.between(-45, 45), y = random.between(-9, 9);
      there.push_back({fmt::format("v{}", number), "antenna", {{std::max(frame - 0.4, 0.0), x, y, 0}}});
    }
  }
  while (!there.empty()) leave(frame_count - 1);
  return config;
}

struct Mode {
  std::string name;
  bool same_rays;  // the same rays as the plain launch: then the bytes are the same, too
  std::function<void(Config&)> set;
};

const Mode modes[] = {
    {"plain", true, [](Config&) {}},
    {"auto", false, [](Config& c) { c.trace.rays = {}; }},
    {"ordered", true, [](Config& c) { c.order = {.method = "H3DH"}; }},
    {"each depth", true, [](Config& c) { c.order = {.method = "direction-origin", .each_depth = true}; }},
    {"small batches", true, [](Config& c) { c.trace.batch_rays = 1000; }},
    {"small batches, each depth", true,
     [](Config& c) {
       c.trace.batch_rays = 3000;
       c.order = {.method = "Z", .each_depth = true};
     }},
    {"cache", true, [](Config& c) {
       c.cache.kind = "concurrent";
       c.cache.key = "exact";
     }}};

std::vector<FrameResult> cold_frames(Config config) {
  config.trace.reuse = false;
  Simulation simulation(config);
  std::vector<FrameResult> out;
  for (uint32_t frame = 0; frame < frame_count; ++frame) out.push_back(simulation.run_frame(frame));
  return out;
}

}  // namespace

TEST_CASE("random arrivals and departures: every launch, with reuse and without, with shards and without") {
  const SceneFile file(street());
  const Config plain = traffic(file.path(), 3, 16000);
  const std::vector<FrameResult> expected = cold_frames(plain);
  size_t paths = 0;
  for (const FrameResult& frame : expected) paths += frame.paths.size();
  REQUIRE(paths > 1000);
  for (const Mode& mode : modes)
    for (const auto& [reuse, shard] : {std::pair{false, frame_count}, {true, frame_count}, {true, 2u}}) {
      Config config = plain;
      mode.set(config);
      config.trace.reuse = reuse;
      Simulation simulation(config);
      for (uint32_t frame = 0; frame < frame_count; ++frame) {
        if (frame % shard == 0) simulation.forget();
        const FrameResult found = simulation.run_frame(frame);
        CAPTURE(mode.name);
        CAPTURE(reuse);
        CAPTURE(shard);
        CAPTURE(frame);
        CHECK(missing(expected[frame].paths, found.paths) == 0);
        CHECK(missing(found.paths, expected[frame].paths) == 0);
        if (mode.same_rays && !reuse) CHECK(identical(found.paths, expected[frame].paths));
      }
    }
}

TEST_CASE("launches of few rays that grow: the same bytes in every order") {
  const SceneFile file(street());
  for (const uint64_t rays : {7u, 60u, 64u, 300u}) {
    const Config plain = traffic(file.path(), 3, rays);
    const std::vector<FrameResult> expected = cold_frames(plain);
    for (const Mode& mode : modes) {
      if (!mode.same_rays) continue;
      CAPTURE(rays);
      CAPTURE(mode.name);
      Config config = plain;
      mode.set(config);
      const std::vector<FrameResult> found = cold_frames(config);
      for (uint32_t frame = 0; frame < frame_count; ++frame) {
        CAPTURE(frame);
        CHECK(identical(found[frame].paths, expected[frame].paths));
      }
    }
  }
}

TEST_CASE("from 1 to 4 launchers and back, live, with a client that forgets: \"auto\" finds what a plain launch does") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {}, {{27.1, 5.21, 1.9}}, {}, 2);
  config.vehicle_types = {{.name = "antenna", .model = "none", .length_m = 4, .width_m = 2, .height_m = 1}};
  config.live_vehicles = {{"antenna", 16}};
  config.mounts = {{.name = "roof", .on = "antenna", .role = "both", .offset_m = {0, 0, 1.7}}};
  Simulation refined(config);
  config.trace.rays = 16000;
  Simulation plain(config);
  LiveTraffic refined_traffic, plain_traffic;
  double time_s = 0;
  const std::pair<uint32_t, bool> frames[] = {{4, true},   {4, false}, {1, true},  {4, false},  {1, false}, {16, false},
                                              {4, true},   {16, true}, {4, false}, {16, false}, {4, true},  {3, true},
                                              {12, false}, {3, true},  {2, true},  {8, false},  {2, true},  {1, false}};
  for (const auto& [count, cold] : frames) {
    CAPTURE(count);
    CAPTURE(cold);
    std::vector<LivePose> poses;
    for (uint32_t i = 0; i < count; ++i) {
      poses.emplace_back().id = fmt::format("v{}", i);
      poses.back().type = "antenna";
      poses.back().position_m = {-42.3 + 5.3 * i, -8.7 + 1.3 * i + 0.1 * time_s, 0};
    }
    if (cold) refined.forget();
    plain.forget();
    const FrameResult found = refined.run_poses(refined_traffic, time_s, poses).result;
    const FrameResult expected = plain.run_poses(plain_traffic, time_s, poses).result;
    CHECK(expected.paths.size() > 4 * count);
    CHECK(missing(expected.paths, found.paths) == 0);
    CHECK(missing(found.paths, expected.paths) == 0);
    time_s += 0.1;
  }
}
