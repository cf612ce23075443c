// SPDX-License-Identifier: Apache-2.0
// Tests frames at the limits of the options: no reflection, no depth, nothing to hit, ends at one place, many
// receivers. Each must give a result and never crash.
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const Quad ground{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}};

}  // namespace

TEST_CASE("no reflection, or depth 0: the line of sight alone, and no ray is launched") {
  const SceneFile file({ground});
  Config config = config_of(file.path(), {{0, 0, 2}}, {{10, 0, 2}}, 10000, 3);
  CHECK(run(config).paths.size() == 2);
  config.trace.reflection = false;
  const FrameResult direct = run(config);
  CHECK(direct.paths.depth == std::vector<uint32_t>{0});
  CHECK(direct.counts.rays == 0);
  CHECK(direct.paths.delay_s[0] == doctest::Approx(10 / speed_of_light).epsilon(1e-12));
  config.trace.reflection = true;
  config.trace.max_depth = 0;
  CHECK(identical(run(config).paths, direct.paths));
}

TEST_CASE(
    "the scene's one small plate, kilometres away: rays are aimed at it, and it mirrors nothing to the receiver") {
  const SceneFile file({{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}});
  const FrameResult frame = run(config_of(file.path(), {{5000, 5000, 5000}}, {{5010, 5000, 5000}}, 1000, 5));
  CHECK(frame.counts.hits > 100);
  CHECK(frame.counts.sequences == 1);
  REQUIRE(frame.paths.size() == 1);
  CHECK(frame.paths.depth[0] == 0);
}

TEST_CASE("a receiver at a transmitter: no line of sight, the echoes remain") {
  const SceneFile file({ground});
  const FrameResult frame = run(config_of(file.path(), {{1, 2, 3}}, {{1, 2, 3}}, 10000, 3));
  REQUIRE(frame.paths.size() == 1);
  CHECK(frame.paths.delay_s[0] == doctest::Approx(6 / speed_of_light).epsilon(1e-12));
  // There is no path at all where no surface can reflect.
  const SceneFile away({{{100, 100, 0}, {1, 0, 0}, {0, 1, 0}}});
  CHECK(run(config_of(away.path(), {{1, 2, 3}}, {{1, 2, 3}}, 10000, 3)).paths.size() == 0);
}

TEST_CASE("behind a wall there is nothing, in front of it everything") {
  const SceneFile file({{{0, -100, -100}, {0, 200, 0}, {0, 0, 200}}});
  const FrameResult frame = run(config_of(file.path(), {{-5, 0, 0}}, {{5, 0.1, 0.2}, {-4, 1, 2}}, 10000, 5));
  CHECK(rows_of(frame.paths, 0, 0).empty());
  CHECK(rows_of(frame.paths, 0, 1).size() == 2);
}

TEST_CASE("inside a closed box nothing is heard from outside") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {4, 4, 4}));
  const FrameResult frame =
      run(config_of(file.path(), {{2, 2.1, 1.9}, {10, 2, 2}}, {{12, 3, 2.5}, {1, 1.2, 1.3}}, 100000, 3));
  CHECK(rows_of(frame.paths, 0, 0).empty());
  CHECK(rows_of(frame.paths, 1, 1).empty());
  CHECK(rows_of(frame.paths, 0, 1).size() == 63);
  CHECK(rows_of(frame.paths, 1, 0).size() == 2);  // the line of sight, and the wall x = 4 from outside
}

TEST_CASE("1,000 receivers and 3 transmitters over a ground: two paths per link, each of its own length") {
  const SceneFile file({ground});
  Points receivers;
  for (int i = 0; i < 1000; ++i) receivers.push_back({-40 + 0.08 * i, 30 - 0.05 * i, 1.5});
  const Points transmitters{{0, 0, 10}, {20, -20, 5}, {-30, 10, 3}};
  const Paths paths = run(config_of(file.path(), transmitters, receivers, 10000, 3)).paths;
  REQUIRE(paths.size() == 6000);
  double worst = 0;
  for (size_t i = 0; i < paths.size(); ++i) {
    CHECK(paths.tx[i] == i / 2000);
    CHECK(paths.rx[i] == i / 2 % 1000);
    const glm::dvec3 tx = transmitters[paths.tx[i]], rx = receivers[paths.rx[i]];
    const double length = glm::distance(paths.depth[i] ? glm::dvec3(tx.x, tx.y, -tx.z) : tx, rx);
    worst = std::max(worst, std::abs(paths.delay_s[i] * speed_of_light / length - 1));
  }
  CHECK(worst < 1e-12);
}

TEST_CASE("one ray is enough for what it meets") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {4, 5, 6}));
  const FrameResult frame = run(config_of(file.path(), {{1, 2, 3}}, {{3, 4, 5}}, 1, 2));
  CHECK(frame.counts.rays == 1);
  CHECK(frame.counts.segments == 2);
  CHECK(frame.paths.size() >= 2);
}

TEST_CASE("the deepest chain: 32 reflections between two mirrors") {
  const SceneFile file({{{-500, 0, -500}, {1000, 0, 0}, {0, 0, 1000}}, {{-500, 2, -500}, {1000, 0, 0}, {0, 0, 1000}}});
  const Paths paths = run(config_of(file.path(), {{0, 0.7, 0}}, {{1, 1.2, 0.3}}, 100000, 32)).paths;
  std::vector<size_t> expected(33, 2);
  expected[0] = 1;
  CHECK(count_by_depth(paths, 0, 32) == expected);
}
