// SPDX-License-Identifier: Apache-2.0
// trace.rays = "auto": as many rays as recall asks for, refined where they still find something.
#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config city(std::optional<uint64_t> rays, uint32_t max_depth) {
  const Points receivers{{60, -2, 1.5}, {-97, 4, 1.5}, {40, 7, 1.5}, {103, 50, 2}, {-3, -80, 1.5}};
  Config config = config_of("", {{0, 0, 12}, {100, 3, 2}}, receivers, rays, max_depth);
  config.scene.generate = "--blocks 4x4";
  return config;
}

}  // namespace

TEST_CASE("what four million rays find, for a fraction of the rays") {
  const FrameResult plain = run(city(4000000, 4)), refined = run(city({}, 4));
  REQUIRE(plain.paths.size() > 100);
  CAPTURE(plain.paths.size());
  CAPTURE(refined.paths.size());
  CHECK(static_cast<double>(missing(plain.paths, refined.paths)) <= 0.01 * static_cast<double>(plain.paths.size()));
  CHECK(refined.counts.rays < 2 * 200000);  // rays of both transmitters
}

TEST_CASE("a launch that ends before its recall says so, and why, once a drive") {
  const auto warnings_of = [](double recall) {
    Config config = city({}, 4);
    config.trace.recall = recall;
    return run(config).warnings;
  };
  CHECK(warnings_of(0.7).empty());
  // Some of the sequences are met by one ray only, but none of them leads to a receiver: only paths count.
  CHECK(warnings_of(0.99).empty());
  const std::vector<std::string> warnings = warnings_of(1);
  REQUIRE(warnings.size() == 1);
  CAPTURE(warnings[0]);
  CHECK(warnings[0].starts_with("the launch of rays = \"auto\" ended before it reached trace.recall = 1: "));
  CHECK(
      warnings[0].ends_with("% of the sequences found were met by only one ray, and its rays cannot come closer "
                            "to each other; give trace.rays a number to find more"));
  // A frame that knows the sequences of earlier frames cannot tell from its own rays what is missed.
  Config config = city({}, 4);
  config.trace.recall = 1;
  config.tracks = {{"a", "passenger", {{0, -60, -3.1, 0}, {2, -40, -3.1, 0}}}};
  config.time.step_s = 1;
  Simulation drive(config);
  CHECK(drive.run_frame(0).warnings.size() == 1);
  CHECK(drive.run_frame(1).warnings.empty());
}

TEST_CASE("max_rays is never exceeded, and what it cuts short is told") {
  for (const uint64_t max_rays : {uint64_t{1000}, uint64_t{20000}, uint64_t{40000}}) {
    CAPTURE(max_rays);
    Config config = city({}, 4);
    config.trace.recall = 0.9999;
    config.trace.max_rays = max_rays;
    const FrameResult result = run(config);
    CHECK(result.counts.rays <= 2 * max_rays);
    CHECK(result.counts.rays > 0);
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0].find("trace.max_rays") != std::string::npos);
  }
}

TEST_CASE("a launch that begins again, because its set of sequences had to grow, counts its rays once") {
  Config config = city({}, 12);
  for (const auto& [x, y] : {std::pair{-50.0, 2.0}, {3, 45}, {-3, -60}, {60, -4}, {102, 50}, {-97, -50}})
    config.transmitters.push_back({.name = fmt::format("tx at {} {}", x, y), .position_m = {x, y, 3}});
  config.trace.recall = 0.9999;
  config.trace.max_rays = 80000;
  const FrameResult result = run(config);
  CHECK(result.counts.sequences > 2 * 262144);  // more than the initial size of the set
  CHECK(result.counts.rays <= 8 * config.trace.max_rays);
  CHECK(result.segments_per_depth[0] > result.counts.rays);  // segments are counted as often as they were traced
}

TEST_CASE("more recall takes more rays and loses no path") {
  Config config = city({}, 4);
  config.trace.recall = 0.9;
  const FrameResult low = run(config);
  config.trace.recall = 0.9995;
  const FrameResult high = run(config);
  CHECK(high.counts.rays > low.counts.rays);
  CHECK(missing(low.paths, high.paths) == 0);
}

TEST_CASE("batches, orders and launch shapes change nothing") {
  Config config = city({}, 4);
  const FrameResult whole = run(config);
  const auto check_same = [&](const FrameResult& other) {
    CHECK(identical(other.paths, whole.paths));
    CHECK(other.counts.rays == whole.counts.rays);
    CHECK(other.counts.sequences == whole.counts.sequences);
    CHECK(other.segments_per_depth == whole.segments_per_depth);
  };
  check_same(run(config));
  for (const uint64_t batch_rays : {uint64_t{1000}, uint64_t{30000}}) {
    CAPTURE(batch_rays);
    config.trace.batch_rays = batch_rays;
    check_same(run(config));
  }
  config.launch.shape = "2d";
  check_same(run(config));
}

TEST_CASE("each transmitter finds what it would alone") {
  const FrameResult both = run(city({}, 3));
  Config config = city({}, 3);
  config.transmitters.erase(config.transmitters.begin());
  const FrameResult alone = run(config);
  size_t of_second = 0;
  for (size_t i = 0; i < both.paths.size(); ++i) of_second += both.paths.tx[i] == 1;
  CHECK(alone.paths.size() > 30);
  // If one of them would have stopped, it continues with the other.
  CHECK(std::abs(static_cast<double>(alone.paths.size()) - static_cast<double>(of_second)) <=
        0.02 * static_cast<double>(of_second));
}

TEST_CASE("no reflections, no depth, nothing in sight: lines of sight alone, and no rays without need") {
  for (const bool reflection : {false, true}) {
    Config config = config_of("", {{0, 0, 12}}, {{30, -2, 1.5}}, 0, reflection ? 0 : 4);
    config.scene.generate = "--blocks 2x2";
    config.trace.reflection = reflection;
    const FrameResult result = run(config);
    CHECK(result.paths.size() == 1);
    CHECK(result.counts.rays == 0);
    CHECK(result.warnings.empty());
  }
  // A plate that no uniform launch would meet, far from both ends: rays are launched through the window in which it
  // appears.
  const SceneFile file({Quad{{-5000, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}}});
  const FrameResult alone = run(config_of(file.path(), {{10, 0, 0}}, {{20, 0, 5}}, {}, 3));
  CHECK(alone.paths.size() == 1);
  CHECK(alone.counts.hits > alone.counts.rays / 2);
  CHECK(alone.warnings.empty());
}

TEST_CASE("a drive begins with a refined launch and goes on with shares of a plain one") {
  Config config = city({}, 3);
  add_vehicles(config,
               {{"a", "passenger", {-60, -3.1, 0}, {11.3, 0.02, 0}, 0, 2},
                {"lorry", "truck", {64, 3.2, 0}, {-8.7, -0.03, 0}, 0, 2}},
               0.5);
  Simulation reusing(config);
  config.trace.reuse = false;
  Simulation cold(config);
  for (uint32_t frame = 0; frame < 5; ++frame) {
    CAPTURE(frame);
    const FrameResult found = reusing.run_frame(frame), all = cold.run_frame(frame);
    if (frame == 0) CHECK(identical(found.paths, all.paths));
    CHECK(static_cast<double>(missing(all.paths, found.paths)) <= 0.05 * static_cast<double>(all.paths.size()));
  }
}
