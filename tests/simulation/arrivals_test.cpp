// Vehicles that come and go, in every way of launching: each frame has the paths of a cold plain launch of its own.
// The street and its rays are such that every launch finds all paths: vehicles are antennas without bodies, walls large.
#include <functional>

#include "passes/triangles.hpp"
#include "simulation/drive.hpp"
#include "wavetracer/live.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t frame_count = 12;

// Vehicles that are there from one random frame to another, and often in numbers that differ by a factor of four.
Config traffic(const std::filesystem::path& scene, uint32_t seed, uint64_t rays) {
  Random random(seed);
  Config config = config_of(scene, {}, {{27.1, 5.21, 1.9}}, rays, 2);
  config.vehicle_types = {{.name = "antenna", .model = "none", .length_m = 4, .width_m = 2, .height_m = 1}};
  for (int i = 0; i < 11; ++i) {
    const bool always = i == 0;  // the drive has one length
    const uint32_t from = always ? 0 : random.below(frame_count), until = always ? frame_count : random.below(frame_count);
    TrackConfig track{fmt::format("v{}", i), "antenna", {}};
    for (const double time_s : {std::min(from, until) - 0.4, std::max(from, until) + 0.4}) {
      const double at_s = std::clamp(time_s, 0.0, frame_count - 1.0);
      track.waypoints.push_back({at_s, -42.3 + 8.1 * i + 1.3 * at_s, -8.7 + 1.9 * i, 0});
    }
    config.tracks.push_back(track);
  }
  config.time.step_s = 1;
  config.mounts = {{.name = "roof", .on = "antenna", .role = "both", .offset_m = {0, 0, 1.7}}};
  return config;
}

struct Mode {
  const char* name;
  bool same_rays;  // as the plain launch: then also the same bytes
  std::function<void(Config&)> set;
};

const Mode modes[] = {
    {"plain", true, [](Config&) {}},
    {"auto", false, [](Config& c) { c.trace.rays = 0; }},
    {"ordered", true, [](Config& c) { c.order = {.method = "H3DH"}; }},
    {"each depth", true, [](Config& c) { c.order = {.method = "direction-origin", .each_depth = true}; }},
    {"small batches", true, [](Config& c) { c.trace.batch_rays = 1000; }},
    {"small batches, each depth", true,
     [](Config& c) {
       c.trace.batch_rays = 3000;
       c.order = {.method = "Z", .each_depth = true};
     }},
    {"cache", true,
     [](Config& c) {
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
  for (const uint32_t seed : {1u}) {
    const Config plain = traffic(file.path(), seed, 16000);
    const std::vector<FrameResult> expected = cold_frames(plain);
    size_t paths = 0;
    for (const FrameResult& frame : expected) paths += frame.paths.size();
    REQUIRE(paths > 1000);
    for (const Mode& mode : modes)
      for (const bool reuse : {false, true})
        for (const uint32_t shard : {frame_count, 3u}) {
          if (!reuse && shard < frame_count) continue;  // every frame is cold already
          Config config = plain;
          mode.set(config);
          config.trace.reuse = reuse;
          Simulation simulation(config);
          for (uint32_t frame = 0; frame < frame_count; ++frame) {
            if (frame % shard == 0) simulation.forget();
            const FrameResult found = simulation.run_frame(frame);
            CAPTURE(seed);
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
  Config config = config_of(file.path(), {}, {{27.1, 5.21, 1.9}}, 0, 2);
  config.vehicle_types = {{.name = "antenna", .model = "none", .length_m = 4, .width_m = 2, .height_m = 1}};
  config.live_vehicles = {{"antenna", 16}};
  config.mounts = {{.name = "roof", .on = "antenna", .role = "both", .offset_m = {0, 0, 1.7}}};
  Simulation refined(config);
  config.trace.rays = 16000;
  Simulation plain(config);
  LiveTraffic refined_traffic, plain_traffic;
  double time_s = 0;
  for (const uint32_t count : {4u, 1u, 4u, 16u, 4u, 1u, 3u, 12u, 3u, 8u, 2u, 8u})
    for (const bool cold : {false, true, false}) {
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
