// SPDX-License-Identifier: Apache-2.0
// Tests that orders and launch shapes change time but never paths: the bytes are the same as without, at launch and
// before each depth. "auto" chooses one of them, says why, and keeps its choice for the next run.
#include <array>
#include <cstdlib>
#include <filesystem>

#include "simulation/run.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config town(Directions directions) {
  Config config =
      config_of("", {{0, 0, 12}, {100, 3, 2}}, {{60, -2, 1.5}, {-97, 4, 1.5}, {40, 7, 1.5}, {103, 50, 2}}, 60000, 4);
  config.scene.generate = "--blocks 4x4";
  config.trace.directions = directions;
  return config;
}

void check_same(const FrameResult& a, const FrameResult& b) {
  CHECK(identical(a.paths, b.paths));
  CHECK(a.counts.sequences == b.counts.sequences);
  CHECK(a.counts.candidates == b.counts.candidates);
  CHECK(a.counts.hits == b.counts.hits);
  CHECK(a.segments_per_depth == b.segments_per_depth);
}

constexpr OrderMethod methods[] = {"WS", "Z", "H3DH", "HZ", "H3DH2DH", "H3DH3DH", "direction-origin"};

}  // namespace

TEST_CASE("every order, at launch and before each depth: the same bytes as none") {
  for (const Directions directions : std::to_array<Directions>({"random", "hilbert"})) {
    Config config = town(directions);
    const FrameResult plain = run(config);
    REQUIRE(plain.counts.paths > 40);
    for (const OrderMethod method : methods)
      for (const bool each_depth : {false, true}) {
        CAPTURE(directions);
        CAPTURE(method);
        CAPTURE(each_depth);
        config.order.method = method;
        config.order.each_depth = each_depth;
        const FrameResult ordered = run(config);
        check_same(ordered, plain);
        CHECK((ordered.seconds.contains("sort") && ordered.seconds.at("sort") > 0) == (method != "WS"));
      }
  }
}

TEST_CASE("every launch shape and group size: the same bytes") {
  Config config = town("random");
  const FrameResult plain = run(config);
  for (const LaunchDimensions shape : std::to_array<LaunchDimensions>({"1d", "2d", "3d"}))
    for (const std::optional<uint32_t> local : {std::optional<uint32_t>{}, {8u}, {64u}})
      for (const OrderMethod method : std::to_array<OrderMethod>({"none", "H3DH"})) {
        CAPTURE(shape);
        CAPTURE(local.value_or(0));
        CAPTURE(method);
        config.launch.shape = shape;
        config.launch.local_size = local;
        config.order.method = method;
        check_same(run(config), plain);
      }
}

TEST_CASE("orders across batches, and any number of bins: the same bytes") {
  Config config = town("random");
  const FrameResult plain = run(config);
  config.order.method = "hilbert3d-histogram";
  config.order.each_depth = true;
  for (const uint64_t batch : {uint64_t{1000}, uint64_t{65537}}) {
    config.trace.batch_rays = batch;
    check_same(run(config), plain);
  }
  config.trace.batch_rays = {};
  for (const uint32_t bins : {1u, 20u, 1024u}) {
    config.order.bin_num = bins;
    check_same(run(config), plain);
  }
}

TEST_CASE("auto says what it chose and why, keeps it, and finds the same paths") {
  const auto cache = std::filesystem::temp_directory_path() / "wavetracer_order_test";
  std::filesystem::remove_all(cache);
  const char* before = std::getenv("XDG_CACHE_HOME");
  const std::string restored = before ? before : "";
  ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  Config config = town("random");
  const Paths plain = run(config).paths;
  config.order.method = "auto";
  Simulation first(config);
  CHECK(first.order().reason.find("was chosen by tracing 60,000 rays in every order") != std::string::npos);
  CHECK(first.order().reason.find("none ") != std::string::npos);
  CHECK(first.order().reason.find("direction-origin at each depth ") != std::string::npos);
  CHECK(identical(first.run_frame(0).paths, plain));
  Simulation second(config);
  CHECK(second.order().method == first.order().method);
  CHECK(second.order().each_depth == first.order().each_depth);
  CHECK(second.order().launch_shape == first.order().launch_shape);
  CHECK(second.order().reason == first.order().reason + " (kept from an earlier run)");
  config.trace.rays = 1000;  // another set of options, so the choice does not apply
  CHECK(Simulation(config).order().reason.find("kept") == std::string::npos);
  if (before)
    ::setenv("XDG_CACHE_HOME", restored.c_str(), 1);
  else
    ::unsetenv("XDG_CACHE_HOME");
  std::filesystem::remove_all(cache);
}

TEST_CASE("configurations built in code are checked too") {
  Config config = town("random");
  config.order.method = "H3DH2DH";
  config.launch.shape = "1d";
  CHECK_THROWS_AS(Simulation{config}, ConfigError);
  config.launch = {"2d", 48};
  CHECK_THROWS_AS(Simulation{config}, ConfigError);
}
