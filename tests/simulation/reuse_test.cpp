// SPDX-License-Identifier: Apache-2.0
// Tests trace.reuse: sequences of earlier frames are solved again. This gives only true paths, nearly all of them for a
// tenth of the rays, the same bits whenever the same frames are computed, and a set of sequences whose size stays
// bounded.
#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Vehicles in the streets of a small city, one of which appears late and one of which vanishes early.
Config city(uint64_t rays, uint32_t max_depth, double duration_s, double step_s) {
  Config config = config_of("", {{3, 5, 6}}, {{52, -7, 1.5}, {-46, 4, 1.5}, {7, 60, 2}, {103, 30, 2}}, rays, max_depth);
  config.scene.generate = "--blocks 4x4";
  add_vehicles(config,
               {{"a", "passenger", {-60, -3.1, 0}, {11.3, 0.02, 0}, 0, duration_s},
                {"b", "passenger", {2.9, 70, 0}, {0.01, -9.1, 0}, duration_s / 4, duration_s},
                {"lorry", "truck", {64, 3.2, 0}, {-8.7, -0.03, 0}, 0, 3 * duration_s / 4}},
               step_s);
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  return config;
}

void check_same(const FrameResult& a, const FrameResult& b) {
  CHECK(identical(a.paths, b.paths));
  CHECK(a.counts.sequences == b.counts.sequences);
  CHECK(a.counts.candidates == b.counts.candidates);
  CHECK(a.counts.solved == b.counts.solved);
  CHECK(a.counts.rays == b.counts.rays);
  CHECK(a.segments_per_depth == b.segments_per_depth);
}

std::vector<FrameResult> frames(Simulation& simulation, std::initializer_list<uint32_t> numbers) {
  std::vector<FrameResult> out;
  for (const uint32_t frame : numbers) out.push_back(simulation.run_frame(frame));
  return out;
}

}  // namespace

TEST_CASE("nothing is carried over unchecked: every path of a frame that reuses is one of a large cold launch") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {{-31.3, 2.17, 4.1}}, {{27.1, 5.21, 1.9}, {-8.7, 9.4, 1.3}}, 40000, 3);
  add_vehicles(config,
               {{"a", "passenger", {-20.3, -3.1, 0}, {9.7, 0.4, 0}, 0, 4},
                {"b", "passenger", {30.7, 3.9, 0}, {-11.3, 0.3, 0}, 0, 2.5},
                {"lorry", "truck", {19.6, 7.1, 0}, {-7.9, -0.7, 0}, 1, 4}},
               0.25);
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  Config large = config;
  large.trace.reuse = false;
  large.trace.rays = 4000000;
  Simulation reusing(config), cold(large);
  size_t paths = 0, by_vehicles = 0;
  for (uint32_t frame = 0; frame < reusing.frame_count(); ++frame) {
    const FrameResult found = reusing.run_frame(frame);
    if (frame % 3 != 0) continue;
    CAPTURE(frame);
    CHECK(missing(found.paths, cold.run_frame(frame).paths) == 0);
    paths += found.paths.size();
    by_vehicles += paths_by_vehicles(found.paths);
  }
  CHECK(paths > 300);
  CHECK(by_vehicles > 20);
}

TEST_CASE("a tenth of the rays in each frame finds what cold frames find") {
  Config config = city(200000, 4, 2, 0.1);
  Simulation reusing(config);
  config.trace.reuse = false;
  Simulation cold(config);
  for (uint32_t frame = 0; frame < 16; ++frame) {
    CAPTURE(frame);
    const FrameResult found = reusing.run_frame(frame);
    if (frame < 5) continue;
    const FrameResult all = cold.run_frame(frame);
    CHECK(found.counts.rays * 10 == all.counts.rays);
    REQUIRE(all.paths.size() > 100);
    CHECK(static_cast<double>(missing(all.paths, found.paths)) <= 0.02 * static_cast<double>(all.paths.size()));
  }
}

TEST_CASE("without reuse a frame is the same to the last bit, whatever was run before it") {
  Config config = city(50000, 3, 2, 0.2);
  config.trace.reuse = false;
  Simulation one(config), other(config);
  frames(one, {0, 1, 2, 7, 3});
  check_same(one.run_frame(5), other.run_frame(5));
  check_same(one.run_frame(5), other.run_frame(5));
}

TEST_CASE("a frame with far more than the one before is as complete as if it came first") {
  // Thirty more cars appear at once: lists are several times as long as predicted (passes/counters.hpp).
  for (const bool reuse : {false, true}) {
    CAPTURE(reuse);
    Config config = city(20000, 3, 2, 0.2);
    config.trace.reuse = reuse;
    std::vector<Straight> crowd;
    for (int i = 0; i < 30; ++i)
      crowd.push_back({fmt::format("crowd{}", i),
                       "passenger",
                       {-70 + 5.5 * i, i % 2 ? -4.1 : 4.3, 0},
                       {i % 2 ? 0.7 : -0.6, 0.01, 0},
                       0.9,
                       2});
    add_vehicles(config, crowd, 0.2);
    Simulation one(config), other(config);
    const std::vector<FrameResult> before = frames(one, {1, 2, 3, 4});
    if (reuse) frames(other, {1});  // with the same sequences, and lengths that were not foreseen yet
    if (reuse) one.forget(), other.forget();
    const FrameResult full = one.run_frame(6);
    CHECK(full.paths.size() > before.back().paths.size() * 5 / 4 + 1024);
    check_same(full, other.run_frame(6));
    check_same(one.run_frame(6), other.run_frame(6));
  }
}

TEST_CASE("after forget() a frame is a first frame, to the last bit") {
  const Config config = city(50000, 3, 2, 0.2);
  Simulation one(config), other(config);
  const std::vector<FrameResult> before = frames(one, {0, 1, 2, 3});
  CHECK(before[0].counts.rays > 5 * before[1].counts.rays);
  one.forget();
  check_same(one.run_frame(4), other.run_frame(4));
}

TEST_CASE("the same frames in the same order give the same bits: again, in other batches, with sorted rays") {
  Config config = city(50000, 4, 3, 0.1);
  config.trace.forget_frames = 4;
  const auto order = {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 20u, 21u, 9u};
  Simulation one(config);
  const std::vector<FrameResult> first = frames(one, order);
  one.forget();
  const std::vector<FrameResult> again = frames(one, order);
  config.trace.batch_rays = 7000;
  Simulation batched(config);
  const std::vector<FrameResult> small = frames(batched, order);
  config.trace.batch_rays = {};
  config.order = {.method = "H3DH", .each_depth = true};
  Simulation ordered(config);
  const std::vector<FrameResult> sorted = frames(ordered, order);
  for (size_t i = 0; i < first.size(); ++i) {
    CAPTURE(i);
    check_same(again[i], first[i]);
    check_same(small[i], first[i]);
    check_same(sorted[i], first[i]);
  }
}

TEST_CASE("the set of sequences does not grow without bound") {
  Config config = city(10000, 3, 8, 0.04);
  config.trace.forget_frames = 10;
  Simulation forgetting(config);
  config.trace.forget_frames = 1000;
  Simulation keeping(config);
  REQUIRE(forgetting.frame_count() > 200);
  uint64_t early = 0, late = 0, kept = 0;
  for (uint32_t frame = 0; frame < 200; ++frame) {
    const uint64_t count = forgetting.run_frame(frame).counts.sequences;
    if (frame >= 20 && frame < 60) early = std::max(early, count);
    if (frame >= 60) late = std::max(late, count);
    kept = keeping.run_frame(frame).counts.sequences;
  }
  CAPTURE(early);
  CAPTURE(late);
  CAPTURE(kept);
  CHECK(late < 2 * early);
  CHECK(late < kept / 2);
}
