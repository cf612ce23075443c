// SPDX-License-Identifier: Apache-2.0
// Tests that a frame in batches of receivers equals the frame in one, bit for bit; and how receivers are divided into
// batches.
#include "simulation/receiver_batches.hpp"

#include <cstdlib>
#include <optional>
#include <utility>

#include "simulation/bends.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config map_of(const SceneFile& file) {
  Config config = map_over_boxes(file, 20000, 2, 5);
  config.trace.diffraction_rays = 3000;
  return config;
}

// While it exists, this many candidates are listed at a time.
class MostCandidates {
 public:
  explicit MostCandidates(const char* most) { setenv("WAVETRACER_MOST_CANDIDATES", most, 1); }
  ~MostCandidates() { unsetenv("WAVETRACER_MOST_CANDIDATES"); }
};

}  // namespace

TEST_CASE("receivers are cut into ranges that hold each of them once") {
  TraceConfig trace;
  uint64_t memory = 8ull << 30;
  const auto cut = [&](uint32_t receivers) {
    std::vector<std::pair<uint32_t, uint32_t>> out;
    for (const ReceiverRange& batch : receiver_batches(trace, receivers, memory))
      out.emplace_back(batch.first, batch.end);
    return out;
  };
  using Cut = std::vector<std::pair<uint32_t, uint32_t>>;
  const Cut whole{{0, no_end}};
  CHECK(cut(1000000) == whole);  // a receiver that launches no rays keeps nothing
  CHECK(receiver_batches(trace, 10, memory, 6).size() == 2);
  CHECK(receiver_batches(trace, 6, memory, 6).size() == 1);
  trace.diffraction = true;
  CHECK(cut(8192) == whole);
  CHECK(cut(8193) == Cut{{0, 8192}, {8192, 8193}});
  memory = 80ull << 30;
  CHECK(cut(30000) == whole);
  CHECK(cut(50000).size() == 2);
  trace.batch_receivers = 3;
  CHECK(cut(3) == whole);
  CHECK(cut(7) == Cut{{0, 3}, {3, 6}, {6, 7}});
  trace.batch_receivers = 4294967295u;
  CHECK(cut(4294967295u) == whole);
}

TEST_CASE("a frame in batches of receivers is the frame in one, bit for bit") {
  const SceneFile file(two_boxes());
  Config config = map_of(file);
  config.radio.frequencies_hz = {config.radio.frequency_hz, 2 * config.radio.frequency_hz};
  config.response = {.bandwidth_hz = 20e6};
  const FrameResult whole = run(config);
  REQUIRE(whole.paths.size() > 500);
  REQUIRE(whole.carriers.size() == 1);
  REQUIRE(whole.responses.h.size() > 100);
  for (const uint32_t batch : {1u, 10u, 37u}) {
    CAPTURE(batch);
    config.trace.batch_receivers = batch;
    bool within = true;
    uint64_t least = 0, most = 0;  // range of the steps on paths
    uint64_t part = 0;
    Simulation simulation(config);
    simulation.observe([&](const FrameProgress& at) {
      within = within && at.done <= at.total && at.part >= part && at.part < at.parts;
      part = at.part;
      if (at.stage == "paths") within = within && at.done >= std::exchange(least, at.done), most = at.total;
      return true;
    });
    const FrameResult found = simulation.run_frame(0);
    CHECK(within);
    CHECK(least == most);  // at the end of the last batch
    const auto receivers = static_cast<uint32_t>(whole.world.receivers.size());
    CHECK(part + 1 == receiver_batches(config.trace, receivers, 0).size());
    CHECK(identical(found.paths, whole.paths));
    CHECK(found.paths.quarters == whole.paths.quarters);
    CHECK(found.carriers.at(0).a == whole.carriers[0].a);
    CHECK(found.carriers[0].frequency_hz == whole.carriers[0].frequency_hz);
    CHECK(found.responses.row_offset == whole.responses.row_offset);
    CHECK(found.responses.h == whole.responses.h);
    CHECK(found.world.links == whole.world.links);
    CHECK(found.missed.paths == whole.missed.paths);
    CHECK(found.counts.paths == whole.counts.paths);
    CHECK(found.counts.rays > whole.counts.rays);  // transmitters launch again
    CHECK(simulation.run_block(0, {1, 3}).paths.size() < whole.paths.size());
  }
}

TEST_CASE("candidates that are listed in parts make the frame that is listed at once, bit for bit") {
  const SceneFile file(two_boxes());
  Config config = map_of(file);
  config.trace.max_diffractions = 2;
  config.trace.max_depth = 3;
  const FrameResult whole = run(config);
  REQUIRE(whole.paths.size() > 500);
  for (const char* const most : {"4000", "2000"}) {
    CAPTURE(most);
    const MostCandidates limit(most);
    const FrameResult parts = run(config);
    CHECK(identical(parts.paths, whole.paths));
    CHECK(parts.paths.quarters == whole.paths.quarters);
    CHECK(parts.counts.candidates == whole.counts.candidates);
    CHECK(parts.counts.solved == whole.counts.solved);
    CHECK(parts.counts.rays == whole.counts.rays);  // nothing is launched again
    CHECK(parts.kernels.at("wedge_solve/wedge_solve").launches > whole.kernels.at("wedge_solve/wedge_solve").launches);
    CHECK(parts.warnings == whole.warnings);
  }
}

TEST_CASE("drives that reuse list their candidates in parts, too") {
  const SceneFile file(two_boxes());
  Config config = map_of(file);
  config.trace.reuse = true;
  config.tracks = {{"car", "passenger", {{0, -12, 9, 0}, {1, -9, 9, 0}}}};
  config.time = {0, 1, 0.25};
  Simulation at_once(config);
  const MostCandidates limit("500");
  Simulation in_parts(config);
  for (uint32_t frame = 0; frame < 4; ++frame)
    CHECK(identical(in_parts.run_frame(frame).paths, at_once.run_frame(frame).paths));
}

TEST_CASE("batches of receivers are halved where their lists are too long, and the frame stays the same") {
  const SceneFile file(two_boxes());
  Config config = map_of(file);
  const FrameResult whole = run(config);
  const auto told = [](const FrameResult& frame) {
    return std::ranges::any_of(frame.warnings, [](const std::string& text) {
      return text.find("trace.batch_receivers = ") != text.npos && text.find("did not fit") != text.npos;
    });
  };
  CHECK_FALSE(told(whole));
  const MostCandidates limit("20");  // fewer than one prefix of a transmitter has with the endings of all receivers
  for (const std::optional<uint32_t> batch : {std::optional<uint32_t>(), std::optional<uint32_t>(30)}) {
    config.trace.batch_receivers = batch;
    Simulation simulation(config);
    for (int time = 0; time < 2; ++time) {
      const FrameResult halved = simulation.run_frame(0);
      CHECK(identical(halved.paths, whole.paths));
      CHECK(told(halved));
    }
  }
  const MostCandidates none("1");
  CHECK_THROWS_WITH_AS(run(config), doctest::Contains("links.max_distance_m"), DeviceError);
}

TEST_CASE("batches without a link are empty, and a frame that is given up goes on with any other") {
  const SceneFile file(two_boxes());
  Config config = map_of(file);
  config.links.max_distance_m = 9;
  const FrameResult whole = run(config);
  config.trace.batch_receivers = 2;
  Simulation simulation(config);
  uint64_t calls = 0;
  simulation.observe([&](const FrameProgress&) { return ++calls < 20; });
  CHECK_THROWS_AS(simulation.run_frame(0), FrameStopped);
  simulation.observe({});
  CHECK(identical(simulation.run_frame(0).paths, whole.paths));
}

TEST_CASE("what antennas that touch leave out is said once for all batches, as for the frame in one") {
  const SceneFile file(two_boxes());
  Config config = map_of(file);
  config.transmitters[0].position_m = {-12.49995, -11, 1.5};  // 0.05 mm beside the first cell of the grid
  config.transmitters[1].position_m = {12.49995, 14, 1.5};    // and beside one of its last row
  const auto left_out = [](const FrameResult& frame) {
    std::vector<std::string> out;
    for (const std::string& warning : frame.warnings)
      if (warning.find("left out") != std::string::npos) out.push_back(warning);
    return out;
  };
  const std::vector<std::string> whole = left_out(run(config));
  REQUIRE(whole.size() == 1);
  config.trace.batch_receivers = 10;
  CHECK(left_out(run(config)) == whole);
}
