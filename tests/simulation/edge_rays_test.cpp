// SPDX-License-Identifier: Apache-2.0
// Tests diffracted paths that are found by rays from edges (trace.edge_rays): they are those that receivers' rays find,
// bit for bit, on maps, for single receivers and for stations, in one batch or several; and what does not go with them
// is refused.
#include "simulation/bends.hpp"
#include "simulation/listeners.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config town(const SceneFile& file) { return map_over_boxes(file, 100000, 3, 3); }

Config by_edges(Config config, uint64_t rays) {
  config.trace.edge_rays = rays;
  return config;
}

}  // namespace

TEST_CASE("rays from edges find what many rays of receivers find, bit for bit") {
  const SceneFile file(two_boxes());
  const Config config = town(file);
  const FrameResult expected = run(config), found = run(by_edges(config, 3000));
  REQUIRE(expected.paths.size() > 2000);
  CHECK(found.paths.size() > 2000);
  // Both launches are samples.
  CHECK(missing(expected.paths, found.paths) < expected.paths.size() / 500);
  CHECK(missing(found.paths, expected.paths) < expected.paths.size() / 500);
  CHECK(found.counts.rays > 2 * 100000);
  CHECK(found.counts.rays < expected.counts.rays / 2);
  CHECK(found.missed.frames == 1);
}

TEST_CASE("few rays from edges find less, and nothing that is none") {
  const SceneFile file(two_boxes());
  const Config config = town(file);
  const FrameResult many = run(by_edges(config, 3000)), few = run(by_edges(config, 16));
  CHECK(few.paths.size() < many.paths.size());
  CHECK(few.paths.size() > many.paths.size() / 4);
  CHECK(missing(few.paths, many.paths) < few.paths.size() / 200);
}

TEST_CASE("batches of receivers share the rays of edges: the frame is that in one batch") {
  const SceneFile file(two_boxes());
  Config config = by_edges(town(file), 500);
  const FrameResult whole = run(config);
  for (const uint32_t batch : {7u, 50u}) {
    CAPTURE(batch);
    config.trace.batch_receivers = batch;
    Simulation simulation(config, "");
    for (int frame = 0; frame < 2; ++frame) {
      const FrameResult cut = simulation.run_frame(0);
      CHECK(identical(cut.paths, whole.paths));
      CHECK(cut.paths.quarters == whole.paths.quarters);
      CHECK(cut.counts.rays == whole.counts.rays);
    }
  }
}

TEST_CASE("what listeners have heard is joined in parts where it makes too many candidates") {
  const SceneFile file(two_boxes());
  const Config config = by_edges(town(file), 500);
  const FrameResult whole = run(config);
  const MostCandidates limit("3000");
  const FrameResult parts = run(config);
  CHECK(identical(parts.paths, whole.paths));
  CHECK(parts.counts.candidates == whole.counts.candidates);
}

TEST_CASE("without reflections, and over heights of all kinds, edges are still heard") {
  const SceneFile file(two_boxes());
  Config config = town(file);
  config.trace.reflection = false;
  config.receiver_grids[0].height_m = 9;
  const FrameResult expected = run(config), found = run(by_edges(config, 3000));
  REQUIRE(expected.paths.size() > 300);
  CHECK(missing(expected.paths, found.paths) <= expected.paths.size() / 200);
}

TEST_CASE("where something moves, rays from edges are refused") {
  const SceneFile file(two_boxes());
  Config config = by_edges(town(file), 100);
  add_vehicles(config, {{"car", "passenger", {-20, 0, 0}, {5, 0, 0}, 0, 1}}, 0.5);
  CHECK_THROWS_WITH_AS(Simulation(config, ""),
                       doctest::Contains("trace.edge_rays needs a world in which nothing moves"), ConfigError);
  config.trace.diffraction = false;
  CHECK(Simulation(config, "").frame_count() > 1);
}

TEST_CASE("receivers in a square are one listener, and each of them is in one") {
  std::vector<EndState> receivers;
  for (const double x : {0.0, 5.0, 19.9, 20.1, 63.0})
    for (const double y : {-3.0, 30.0}) receivers.push_back({.position_m = {x, y, x + y}});
  const Origins origins = hearing_origins(receivers, 4, 20);
  REQUIRE(origins.squares);
  CHECK(origins.transmitter_count() == 4);
  const auto& [first, members] = origins.listeners;
  CHECK(members.size() == receivers.size());
  CHECK(origins.listeners.count() == 6);
  CHECK(origins.squares->columns == 4);
  CHECK(origins.squares->rows == 2);
  std::vector<uint32_t> sorted = members;
  std::ranges::sort(sorted);
  for (uint32_t i = 0; i < sorted.size(); ++i) CHECK(sorted[i] == i);
  for (uint32_t listener = 0; listener < origins.listeners.count(); ++listener)
    for (uint32_t i = first[listener]; i < first[listener + 1]; ++i)
      CHECK(origins.origin_of_receiver[members[i]] == 4 + listener);
  CHECK(origins.squares->low_m == -3);
  CHECK(origins.squares->high_m == 93);
}

TEST_CASE("a single receiver, and receivers in one line, have squares") {
  CHECK(hearing_origins(std::vector<EndState>(1), 1, 20).listeners.count() == 1);
  std::vector<EndState> line;
  for (int i = 0; i < 100; ++i) line.push_back({.position_m = {1e5 * i, 0, 0}});
  const Origins origins = hearing_origins(line, 1, 20);
  CHECK(origins.listeners.count() == 100);
  CHECK(origins.squares->listeners.size() < (1u << 25));
}
