// SPDX-License-Identifier: Apache-2.0
// Tests that the paths are the same bytes whatever the batches, the order of receivers, the other transmitters, and the
// run. In a generated town, where rays do not find everything, and in a box, where they do.
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config town(uint64_t rays) {
  Config config = config_of("", {{0, 0, 12}, {100, 3, 2}},
                            {{60, -2, 1.5}, {-97, 4, 1.5}, {40, 7, 1.5}, {-3, -50, 5}, {103, 50, 2}}, rays, 4);
  config.scene.generate = "--blocks 4x4";
  return config;
}

// Ends of `config` chosen by index.
Config chosen(const Config& config, const std::vector<size_t>& transmitters, const std::vector<size_t>& receivers) {
  Config out = config;
  out.transmitters.clear();
  out.receivers.clear();
  for (const size_t t : transmitters) out.transmitters.push_back(config.transmitters[t]);
  for (const size_t r : receivers) out.receivers.push_back(config.receivers[r]);
  return out;
}

}  // namespace

TEST_CASE("any batch size gives the same bytes, counts included") {
  Config config = town(200000);
  const FrameResult whole = run(config);
  REQUIRE(whole.counts.paths > 50);
  for (const uint64_t batch : {uint64_t{1000}, uint64_t{4096}, uint64_t{65537}, uint64_t{1000000}}) {
    CAPTURE(batch);
    config.trace.batch_rays = batch;
    const FrameResult parts = run(config);
    CHECK(identical(parts.paths, whole.paths));
    CHECK(parts.counts.sequences == whole.counts.sequences);
    CHECK(parts.counts.candidates == whole.counts.candidates);
    CHECK(parts.counts.segments == whole.counts.segments);
    CHECK(parts.counts.hits == whole.counts.hits);
    CHECK(parts.segments_per_depth == whole.segments_per_depth);
  }
}

TEST_CASE("runs and frames repeat each other") {
  Simulation simulation(town(100000));
  const Paths first = simulation.run_frame(0).paths;
  for (int i = 0; i < 3; ++i) CHECK(identical(simulation.run_frame(0).paths, first));
  CHECK(identical(run(town(100000)).paths, first));
}

TEST_CASE("receivers in another order, and alone: the same rows") {
  const Config config = town(100000);
  const Paths all = run(config).paths;
  const std::vector<size_t> order{3, 0, 4, 2, 1};
  const Paths permuted = run(chosen(config, {0, 1}, order)).paths;
  CHECK(permuted.size() == all.size());
  for (uint32_t t = 0; t < 2; ++t)
    for (uint32_t r = 0; r < 5; ++r) CHECK(rows_of(permuted, t, r) == rows_of(all, t, static_cast<uint32_t>(order[r])));
  for (uint32_t r = 0; r < 5; ++r) {
    const Paths alone = run(chosen(config, {0, 1}, {r})).paths;
    for (uint32_t t = 0; t < 2; ++t) CHECK(rows_of(alone, t, 0) == rows_of(all, t, r));
  }
}

TEST_CASE("transmitters alone and together: the same rows") {
  const Config config = town(100000);
  const Paths all = run(config).paths, swapped = run(chosen(config, {1, 0}, {0, 1, 2, 3, 4})).paths;
  for (uint32_t t = 0; t < 2; ++t) {
    const Paths alone = run(chosen(config, {t}, {0, 1, 2, 3, 4})).paths;
    for (uint32_t r = 0; r < 5; ++r) {
      CHECK(rows_of(alone, 0, r) == rows_of(all, t, r));
      CHECK(rows_of(swapped, 1 - t, r) == rows_of(all, t, r));
    }
  }
}

TEST_CASE("in a box all maps of directions find the same paths, and so do more rays") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config = config_of(file.path(), {{1.37, 2.21, 1.55}}, {{6.13, 3.42, 0.87}, {2.9, 0.61, 2.6}}, 300000, 4);
  const Paths hilbert = run(config).paths;
  CHECK(hilbert.size() == 2 * 129);
  for (const Directions map : std::to_array<Directions>({"fibonacci", "random"})) {
    CAPTURE(map);
    config.trace.directions = map;
    CHECK(identical(run(config).paths, hilbert));
  }
  config.trace.directions = "hilbert";
  config.trace.rays = 1000003;
  CHECK(identical(run(config).paths, hilbert));
}

TEST_CASE("the seed changes random directions and nothing else") {
  Config config = town(20000);
  config.trace.directions = "random";
  const FrameResult one = run(config);
  CHECK(run(config).counts.hits == one.counts.hits);
  config.trace.seed = 2;
  CHECK(run(config).counts.hits != one.counts.hits);
}

TEST_CASE("a set that outgrows its table: the same paths and sequences for all batches") {
  // Nearly every ray of a faceted ball lives through a sequence of its own: more than the 2^18 slots to begin with.
  std::vector<Quad> quads;
  for (int i = 0; i < 24; ++i)
    for (int j = -11; j < 11; ++j) {
      const auto point = [](int a, int b) {
        const double phi = a * 0.2617993877991494, theta = b * 0.1308996938995747;  // 15 and 7.5 degrees
        return 10.0 * glm::dvec3{std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), std::sin(theta)};
      };
      const glm::dvec3 corner = point(i, j);
      quads.push_back({corner, point(i + 1, j) - corner, point(i, j + 1) - corner});
    }
  const SceneFile file(quads);
  Config config = config_of(file.path(), {{1.1, 0.4, -0.7}}, {{-3.1, 2.2, 0.9}}, 400000, 5);
  config.trace.directions = "hilbert";
  const FrameResult whole = run(config);
  CHECK(whole.counts.sequences > 1 << 18);
  CHECK(whole.counts.paths > 4);
  config.trace.batch_rays = 50000;
  const FrameResult parts = run(config);
  CHECK(parts.counts.sequences == whole.counts.sequences);
  CHECK(identical(parts.paths, whole.paths));
}
