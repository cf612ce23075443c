// SPDX-License-Identifier: Apache-2.0
// candidates: the rejection by boxes never rejects a pair that the image method in double accepts, and rejects most
// others. Every sequence of random planes against every receiver; grazing legs, and images that are kilometres away.
#include "passes/candidates.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "passes/image_method.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Outcome {
  size_t accepted = 0, lost = 0, candidates = 0, pairs = 0;
};

Outcome compare(const std::vector<Quad>& quads, const std::vector<glm::dvec3>& transmitters,
                const std::vector<glm::dvec3>& receivers, const std::vector<Sequence>& sequences, uint32_t max_depth) {
  const Exact exact(reference::scene_of_quads(quads), transmitters, receivers, sequences, max_depth);
  Outcome out;
  CHECK(exact.candidates.size() == exact.candidate_count);  // none is listed twice
  out.candidates = exact.candidate_count - transmitters.size() * receivers.size();
  for (const Sequence& s : with_prefixes(sequences))
    for (uint32_t r = 0; r < receivers.size(); ++r) {
      ++out.pairs;
      if (!image_method(quads, transmitters[s.transmitter], s.surfaces, receivers[r])) continue;
      ++out.accepted;
      out.lost += !exact.candidates.contains({s, r});
    }
  for (uint32_t t = 0; t < transmitters.size(); ++t)
    for (uint32_t r = 0; r < receivers.size(); ++r) CHECK(exact.candidates.contains({Sequence{t, {}}, r}));
  return out;
}

std::vector<glm::dvec3> random_points(size_t count, double extent, Random& random) {
  std::vector<glm::dvec3> points;
  for (size_t i = 0; i < count; ++i) points.push_back(random.in_cube(extent));
  return points;
}

}  // namespace

TEST_CASE("random planes: nothing that solves is rejected, and most of what does not solve is") {
  Random random(1);
  const std::vector<Quad> quads = random_quads(9, 10, 12, random);
  for (const size_t receivers : {size_t{1}, size_t{15}, size_t{16}, size_t{17}}) {
    CAPTURE(receivers);
    const Outcome o =
        compare(quads, random_points(2, 12, random), random_points(receivers, 12, random), all_sequences(2, 9, 2), 2);
    CHECK(o.lost == 0);
    if (receivers > 1) CHECK(o.accepted > 0);
    CHECK(o.candidates < o.pairs / 8);
  }
}

TEST_CASE("grazing legs: receivers a hair above planes that are seen edge on") {
  Random random(2);
  std::vector<Quad> quads;
  for (int i = 0; i < 6; ++i) quads.push_back({{-500.0 + 150 * i, -400, 0.01 * i}, {160, 3, 0.01}, {-5, 800, -0.02}});
  std::vector<glm::dvec3> receivers;
  for (int i = 0; i < 17; ++i)
    receivers.push_back({random.between(-450, 450), random.between(-380, 380), 0.06 + random() * random() * 0.5});
  const Outcome o = compare(quads, {{-480, 20, 0.3}, {400, -300, 0.07}}, receivers, all_sequences(2, 6, 2), 2);
  CHECK(o.lost == 0);
  CHECK(o.accepted >= 8);
}

TEST_CASE("far images: four reflections between walls that are kilometres apart") {
  Random random(3);
  const std::vector<Quad> quads{{{-4000, -3000, -50}, {8000, 11, 0}, {0, 5, 900}},
                                {{-4000, 2500, -50}, {8000, -17, 0}, {3, -9, 900}},
                                {{-5000, -5000, -40}, {10000, 0, 1}, {0, 10000, 2}}};
  std::vector<glm::dvec3> receivers;
  for (int i = 0; i < 20; ++i)
    receivers.push_back({random.between(-3500, 3500), random.between(-2900, 2400), random.between(-20, 300)});
  const Outcome o = compare(quads, {{-1000, 500, 25}, {2000, -2000, 5}}, receivers, all_sequences(2, 3, 4), 4);
  CHECK(o.lost == 0);
  CHECK(o.accepted > 100);
}

TEST_CASE("receivers in groups: every one once, in groups of 16 that are halves of what they lie in") {
  Random random(6);
  for (const size_t count : {size_t{1}, size_t{16}, size_t{17}, size_t{1000}}) {
    CAPTURE(count);
    std::vector<float> positions;
    for (size_t i = 0; i < 3 * count; ++i) positions.push_back(static_cast<float>(random.between(-100, 100)));
    std::vector<uint32_t> order = grouped(positions);
    double sizes = 0;  // sum of the sizes of the groups' boxes
    for (size_t first = 0; first + 16 <= count; first += 16)
      for (size_t axis = 0; axis < 2; ++axis) {
        float lower = 100, upper = -100;
        for (size_t i = first; i < first + 16; ++i) {
          lower = std::min(lower, positions[3 * order[i] + axis]);
          upper = std::max(upper, positions[3 * order[i] + axis]);
        }
        sizes += upper - lower;
      }
    if (count == 1000) CHECK(sizes / 2 / 62 < 80);  // the points fill a cube of 200 m; its 63rd part is a cube of 50 m
    std::ranges::sort(order);
    for (uint32_t i = 0; i < count; ++i) CHECK(order[i] == i);
  }
}

TEST_CASE("many receivers in groups: none is lost with its group, and receivers that move are found where they are") {
  Random random(5);
  const std::vector<Quad> quads = random_quads(8, 60, 40, random);
  std::vector<glm::dvec3> receivers;
  for (int cluster = 0; cluster < 25; ++cluster) {
    const glm::dvec3 middle = random.in_cube(80);
    for (int i = 0; i < 12; ++i) receivers.push_back(middle + random.in_cube(cluster % 5));
  }
  const std::vector<glm::dvec3> transmitters = random_points(2, 60, random);
  for (int place = 0; place < 2; ++place) {
    const Outcome o = compare(quads, transmitters, receivers, all_sequences(2, 8, 3), 3);
    CHECK(o.lost == 0);
    CHECK(o.accepted > 100);
    CHECK(o.candidates < o.pairs / 20);
    for (glm::dvec3& at : receivers) at += glm::dvec3{0, 30, 0} * random();
  }
}

TEST_CASE("what listeners see is no candidate, nor is a longer sequence than asked for") {
  Random random(4);
  const std::vector<Quad> quads = random_quads(6, 10, 60, random);
  const std::vector<glm::dvec3> transmitters = random_points(2, 12, random), receivers = random_points(25, 12, random);
  const DeviceScene scene = make_device_scene(context(), reference::scene_of_quads(quads), false, 12);
  std::vector<EndState> tx, rx;
  std::vector<Link> links;
  for (const glm::dvec3& p : transmitters) tx.push_back({.position_m = p});
  for (const glm::dvec3& p : receivers) rx.push_back({.position_m = p});
  for (uint32_t t = 0; t < 2; ++t)
    for (uint32_t r = 0; r < 25; ++r) links.push_back({t, r});
  // Ends 2 and 3 are receivers 4 and 1; the trie contains what they see and what the transmitters see.
  const RadioEnds ends = make_radio_ends(context(), tx, rx, links, single_listeners({4, 1}));
  using Found = std::set<std::pair<Sequence, uint32_t>>;
  const auto listed = [&](uint32_t origins, uint32_t max_reflections) {
    Sequences set(context(), 1 << 13);
    enter(set, scene, all_sequences(origins, 6, 3), 3);
    const uint32_t node_count = set.collect(2);
    Candidates find(context(), max_reflections);
    const uint32_t count = find(scene, ends, set.table(), set.nodes(), node_count, set.counters());
    const std::vector<uint64_t> table = set.table().read();
    Found out;
    for (const wt_candidate& c : find.list().read(0, count)) {
      Sequence s;
      uint32_t node = c.node;
      for (; !(node & WT_ROOT); node = static_cast<uint32_t>(table[node] >> 32))
        s.surfaces.insert(s.surfaces.begin(), static_cast<uint32_t>(table[node]));
      s.transmitter = node & ~WT_ROOT;
      CHECK(out.emplace(s, c.receiver).second);
    }
    return out;
  };
  const Found all = listed(2, WT_MAX_DEPTH);
  CHECK(all.size() > 100);
  CHECK(listed(4, WT_MAX_DEPTH) == all);
  for (const uint32_t most : {0u, 1u, 2u, 3u}) {
    CAPTURE(most);
    Found expected;
    for (const auto& candidate : all)
      if (candidate.first.surfaces.size() <= most) expected.insert(candidate);
    CHECK(listed(4, most) == expected);
  }
}
