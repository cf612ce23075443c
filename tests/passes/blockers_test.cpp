// SPDX-License-Identifier: Apache-2.0
// Blockers: a surface that hid a path before is tested first, and the same paths are visible as without it, for all
// motions of the ends and all contents of the table.
#include "passes/blockers.hpp"

#include <doctest/doctest.h>

#include "passes/image_method.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Found = std::set<std::pair<Sequence, uint32_t>>;

// Solves all sequences again and again, with the ends at their current places.
struct Frames {
  std::vector<Quad> quads;
  DeviceScene scene;
  Sequences set{context(), 1 << 14};
  uint32_t node_count = 0;
  Candidates find{context()};
  Solve plain{context(), 3}, remembering{context(), 3, true};
  Occlusion occlusion;
  Blockers blockers{context()};
  uint32_t hidden = 0, solved = 0;

  explicit Frames(uint32_t seed, Random& random)
      : quads(random_quads(8, 10 + seed, 30, random)),
        scene(make_device_scene(context(), reference::scene_of_quads(quads), false, 40)),
        occlusion(context(), scene) {
    enter(set, scene, all_sequences(1, 8, 3), 3);
  }

  Found visible(const RadioEnds& ends, bool remember) {
    set.counters().zero();
    node_count = set.collect(1);
    const uint32_t count = find(scene, ends, set.table(), set.nodes(), node_count, set.counters());
    SolvedList& list = (remember ? remembering : plain)(scene, ends, set.table(), set.quarters(), find.list(), count,
                                                        set.counters(), remember ? &blockers : nullptr);
    if (list.count > 0) occlusion(scene, ends, list, set.counters(), remember ? &blockers : nullptr);
    hidden = set.counters().read(Stage::solve).hidden;
    solved = list.count + hidden;
    Found out;
    if (list.count == 0) return out;
    const std::vector<uint32_t> surfaces = list.sequences.read(0, size_t{list.count} * list.max_depth);
    const std::vector<wt_solved> headers = list.headers.read(0, list.count);
    for (size_t i = 0; i < headers.size(); ++i) {
      const auto* const first = surfaces.data() + i * list.max_depth;
      if (!headers[i].blocked)
        out.insert({{headers[i].transmitter, {first, first + headers[i].depth}}, headers[i].receiver});
    }
    return out;
  }
};

}  // namespace

TEST_CASE("the same paths are visible with and without what hid others before, as ends move") {
  uint32_t hidden = 0;
  size_t visible = 0;
  for (uint32_t seed = 0; seed < as_many(3, 2); ++seed) {
    Random random(seed);
    Frames frames(seed, random);
    glm::dvec3 tx = random.in_cube(8);
    std::vector<glm::dvec3> rx;
    for (int i = 0; i < 20; ++i) rx.push_back(random.in_cube(8));
    for (int frame = 0; frame < 6; ++frame) {
      CAPTURE(frame);
      const RadioEnds ends = standing_ends({tx}, rx);
      const Found expected = frames.visible(ends, false);
      const uint32_t solved = frames.solved;
      CHECK(frames.hidden == 0);
      CHECK(frames.visible(ends, true) == expected);
      CHECK(frames.solved == solved);
      if (frame == 0) CHECK(frames.hidden == 0);
      hidden += frames.hidden;
      visible += expected.size();
      tx += random.in_cube(frame == 3 ? 6 : 0.05);  // includes a jump
      for (glm::dvec3& p : rx) p += random.in_cube(0.05);
    }
  }
  CHECK(hidden > 300);
  CHECK(visible > 100);
}

TEST_CASE("entries of other paths do no harm") {
  Random random(5);
  Frames frames(5, random);
  std::vector<glm::dvec3> rx;
  for (int i = 0; i < 20; ++i) rx.push_back(random.in_cube(8));
  const RadioEnds ends = standing_ends({random.in_cube(8)}, rx);
  const Found expected = frames.visible(ends, false);
  REQUIRE(expected.size() > 10);
  const uint32_t slots = frames.scene.triangle_slots;
  REQUIRE(slots > 0);
  for (uint32_t leg = 0; leg < 5; ++leg)
    for (uint32_t place = 0; place < std::min(slots, 16u); place += as_many(1, 8)) {
      context().fill(frames.blockers.places, leg << 27 | place);
      CHECK(frames.visible(ends, true) == expected);
    }
}
