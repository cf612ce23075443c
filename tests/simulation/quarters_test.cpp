// SPDX-License-Identifier: Apache-2.0
// Tests the quarters of a launch that found a path, and the estimate of paths that none has found.
// The reference of the first is a launch of the rays of a quarter alone.
#include "radio/links.hpp"
#include "simulation/drive.hpp"
#include "simulation/frame.hpp"
#include "simulation/solve_paths.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config town(std::optional<uint64_t> rays, uint32_t max_depth = 4) {
  Config config = config_of("", {{0, 0, 12}, {100, 3, 2}},
                            {{60, -2, 1.5}, {-97, 4, 1.5}, {40, 7, 1.5}, {-3, -50, 5}, {103, 50, 2}}, rays, max_depth);
  config.scene.generate = "--blocks 4x4";
  return config;
}

// A street whose ends send and receive.
Config radios(const SceneFile& file, uint64_t rays, uint32_t max_depth) {
  const Points ends{{-31.3, 2.17, 4.1}, {27.1, 5.21, 1.9}, {-8.7, 9.4, 1.3}};
  Config config = config_of(file.path(), ends, ends, rays, max_depth);
  config.trace.directions = "hilbert";
  return config;
}

// Returns the paths that a launch of these directions alone finds.
Paths found(const Config& config, DirectionShare share) {
  Setup s = make_setup(config, "");
  const WorldState state = s.plan->world.state(0);
  const RadioEnds ends =
      make_radio_ends(s.context, state.transmitters, state.receivers, state.links, s.plan->origins.listeners);
  s.discovery->sequences().clear();
  s.discovery->find(s.device_scene, {.who = sending(state), .rays = *s.plan->trace.rays, .share = share});
  if (s.plan->trace.diffraction)
    s.discovery->find(s.device_scene, {.who = listening(state, s.plan->origins),
                                       .rays = *s.plan->trace.rays / 3,
                                       .share = share,
                                       .followed = false,
                                       .sorted = false});
  FrameAccount account(s.context, 0);
  solve_paths(s.exact_paths, s.device_scene, ends, s.discovery->sequences(), Search::all, *s.frame_watch, account);
  Counters& counters = s.discovery->sequences().counters();
  DiffractedPaths* edges = s.exact_paths.diffraction ? &*s.exact_paths.diffraction : nullptr;
  s.finish.start(0, s.device_scene, edges, nullptr, ends, state, s.exact_paths.visible.list(), nullptr,
                 Rows::first_carrier, counters);
  LeftOut left_out;
  return s.finish.take(counters.read(Stage::fields), left_out, nullptr);
}

bool same_path(const Paths& a, size_t i, const Paths& b, size_t j) {
  if (a.tx[i] != b.tx[j] || a.rx[i] != b.rx[j] || a.depth[i] != b.depth[j]) return false;
  for (uint64_t k = 0; k < a.depth[i]; ++k) {
    const uint64_t at = a.vertex_offset[i] + k, other = b.vertex_offset[j] + k;
    if (a.vertex_interaction[at] != b.vertex_interaction[other] ||
        glm::distance(a.vertex_position_m[at], b.vertex_position_m[other]) > 2e-4)
      return false;
  }
  return true;
}

void check_quarters(const Config& config) {
  const Paths whole = found(config, {});
  REQUIRE(whole.quarters.size() == whole.size());
  size_t rare = 0, wrong = 0;
  for (const uint8_t quarters : whole.quarters) rare += quarters != WT_ALL_QUARTERS;
  for (uint32_t quarter = 0; quarter < 4; ++quarter) {
    const Paths part = found(config, {quarter, 4});
    for (size_t i = 0; i < whole.size(); ++i) {
      bool there = false;
      for (size_t j = 0; j < part.size() && !there; ++j) there = same_path(whole, i, part, j);
      wrong += there != ((whole.quarters[i] >> quarter & 1) != 0);
    }
  }
  CAPTURE(whole.size());
  CHECK(rare > 5);
  CHECK(rare < whole.size());
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("a path has the quarters whose rays find it alone: reflections and their exchanges") {
  Config config = town(6000, 3);
  config.trace.directions = "hilbert";
  check_quarters(config);
}

TEST_CASE("a path has the quarters whose rays find it alone: diffracted, once and twice, on either face") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {{-31.3, 2.17, 4.1}}, {{27.1, 5.21, 1.9}}, 300, 3);
  config.trace.directions = "hilbert";
  config.trace.diffraction = true;
  config.trace.free_edges = true;
  check_quarters(config);
}

TEST_CASE("a path has the quarters whose rays find it alone: transmitted and scattered") {
  const SceneFile file(street());
  Config config = radios(file, 100, 3);
  config.trace.transmission = true;
  check_quarters(config);
  Config rough = town(200, 1);
  rough.trace.directions = "hilbert";
  rough.trace.scattering = true;
  rough.trace.tile_m = 20;
  rough.materials.emplace_back();
  rough.materials[0].name = "concrete";
  rough.materials[0].scattering = 0.3;
  check_quarters(rough);
}

TEST_CASE("of a launch of few rays the interval holds what a large one finds more") {
  const FrameResult truth = run(town(1000000));
  for (const uint64_t rays : {3000, 10000, 30000}) {
    CAPTURE(rays);
    const FrameResult few = run(town(rays));
    REQUIRE(few.missed.frames == 1);
    const auto missed_paths = static_cast<double>(missing(truth.paths, few.paths));
    const Missed missed = estimate_missed(few.missed);
    CAPTURE(missed_paths);
    CAPTURE(missed.paths.low);
    CAPTURE(missed.paths.estimate);
    CAPTURE(missed.paths.high);
    CHECK(missed.paths.low <= missed_paths);
    CHECK(missed_paths <= missed.paths.high);
    if (rays == 3000) CHECK(missed_paths > 0);
    double power = 0, more = 0;
    const std::vector<uint32_t> at = counterparts(truth.paths, few.paths);
    for (size_t i = 0; i < at.size(); ++i)
      for (const auto& a : truth.paths.a[i]) (at[i] == no_row ? more : power) += std::norm(a);
    CHECK(more / power >= missed.power_share.low);
    CHECK(more / power <= missed.power_share.high);
  }
}

TEST_CASE("batches, orders of rays and shapes of launches change no quarter, fixed or refined") {
  for (const std::optional<uint64_t> rays : {std::optional<uint64_t>{20000}, {}}) {
    Config config = town(rays);
    const FrameResult whole = run(config);
    REQUIRE(whole.missed.frames == 1);
    REQUIRE(whole.paths.quarters.size() == whole.paths.size());
    CHECK(whole.missed.paths[0] + whole.missed.paths[1] > 0);
    config.trace.batch_rays = 1000;
    CHECK(run(config).paths.quarters == whole.paths.quarters);
    config.launch.shape = "2d";
    CHECK(run(config).paths.quarters == whole.paths.quarters);
    if (!rays) continue;
    config.order.method = "morton";
    config.order.each_depth = true;
    CHECK(run(config).paths.quarters == whole.paths.quarters);
  }
}

TEST_CASE(
    "frames that reuse know all launches since the first: what was rare is known better, and repeats do not differ") {
  Config config = town(10000);
  config.tracks = {{"a", "passenger", {{0, -60, -3.1, 0}, {2, -59.9, -3.1, 0}}}};
  config.time.step_s = 0.2;
  Simulation drive(config), again(config);
  const FrameResult first = drive.run_frame(0);
  FrameResult last;
  for (uint32_t frame = 1; frame <= 10; ++frame) last = drive.run_frame(frame);
  const auto known = [](const FrameResult& frame) {
    return static_cast<double>(frame.missed.paths[3]) / static_cast<double>(frame.paths.size());
  };
  REQUIRE(last.missed.frames == 1);
  CHECK(known(first) < 1);
  CHECK(known(last) >= known(first));
  for (uint32_t frame = 0; frame <= 10; ++frame) {
    const FrameResult repeated = again.run_frame(frame);
    if (frame == 10) CHECK(repeated.paths.quarters == last.paths.quarters);
  }
}

TEST_CASE("spheres and ray caches say nothing of what was missed; without rays nothing is to be missed") {
  Config config = town(20000, 2);
  config.trace.reception = "sphere";
  const FrameResult sphere = run(config);
  CHECK(sphere.missed.frames == 0);
  CHECK(sphere.paths.quarters.empty());
  config.trace.reception = "exact";
  config.cache.kind = "open";
  const FrameResult cached = run(config);
  CHECK(cached.missed.frames == 0);
  REQUIRE(cached.paths.size() > 0);
  for (const LinkFigures& link : link_figures(cached.paths, 0, cached.world.links, 5.9e9))
    CHECK(std::isnan(link.missed_power_share));
  const FrameResult direct = run(town(20000, 0));
  CHECK(direct.missed.frames == 0);
  for (const LinkFigures& link : link_figures(direct.paths, 0, direct.world.links, 5.9e9))
    if (link.paths > 0) CHECK(link.missed_power_share == 0);
}

TEST_CASE("a block of transmitters knows of its links what the whole frame knows") {
  Config config = town(20000, 3);
  Simulation simulation(config);
  const FrameResult whole = simulation.run_frame(0), second = simulation.run_block(0, {1, 2});
  std::vector<uint8_t> expected;
  for (size_t i = 0; i < whole.paths.size(); ++i)
    if (whole.paths.tx[i] == 1) expected.push_back(whole.paths.quarters[i]);
  CHECK(second.paths.quarters == expected);
  MissedCounts parts = simulation.run_block(0, {0, 1}).missed;
  add_part(parts, second.missed);
  CHECK(parts.frames == 1);
  CHECK(parts.paths == whole.missed.paths);
  CHECK(parts.power == doctest::Approx(whole.missed.power));
}
