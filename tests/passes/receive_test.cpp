// SPDX-License-Identifier: Apache-2.0
// receive: every pair of a segment and a receiver against the distance of a point from a segment in double.
// Links that nobody wants, lists that must grow, rays that a cache has answered, the receiver that comes first.
#include "passes/receive.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <set>

#include "passes/labelled.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Case {
  std::vector<glm::dvec3> transmitters, receivers;
  std::vector<Link> links;
  std::vector<LabelledRay> rays;
  double radius_m = 2;

  RadioEnds ends() const {
    std::vector<EndState> tx(transmitters.size()), rx(receivers.size());
    for (size_t i = 0; i < tx.size(); ++i) tx[i].position_m = transmitters[i];
    for (size_t i = 0; i < rx.size(); ++i) rx[i].position_m = receivers[i];
    return make_radio_ends(context(), tx, rx, links);
  }
  bool wanted(uint32_t tx, uint32_t rx) const { return std::ranges::binary_search(links, Link{tx, rx}); }
};

// Makes random segments, a third of which never end; two of three links are computed.
Case random_case(uint32_t ray_count, uint32_t receiver_count, uint32_t seed) {
  Random random(seed);
  Case c;
  for (int i = 0; i < 3; ++i) c.transmitters.push_back(random.in_cube(10));
  for (uint32_t i = 0; i < receiver_count; ++i) c.receivers.push_back(random.in_cube(10));
  for (uint32_t t = 0; t < 3; ++t)
    for (uint32_t r = 0; r < receiver_count; ++r)
      if (random() < 0.67) c.links.push_back({t, r});
  for (uint32_t i = 0; i < ray_count; ++i) {
    LabelledRay ray{ray_towards(random.in_cube(12), random.direction()), 7 * i + 3, random.below(3), {}};
    ray.ray.node = 1000 + i;
    if (random() < 0.67) ray.hit = {static_cast<float>(random.between(0, 20)), 5, 2};
    c.rays.push_back(ray);
  }
  return c;
}

struct Nearest {
  double along, apart;
};

// Computes as a textbook does: the foot of the perpendicular, or the nearer end.
Nearest nearest(const LabelledRay& r, const glm::dvec3& p) {
  const glm::dvec3 o = to_double(r.ray.origin), d = to_double(r.ray.direction);
  const double foot = glm::dot(p - o, d);
  const double along = std::max(0.0, r.hit.missed() ? foot : std::min(foot, double{r.hit.t}));
  return {along, glm::distance(p, o + along * d)};
}

constexpr double rounding_m = 1e-5;  // rounding of a float32 distance over some 20 m

// Returns (ray, receiver) of receptions, and checks all their other values.
std::map<std::pair<uint32_t, uint32_t>, float> pairs_of(const Case& c, const std::vector<wt_reception>& list,
                                                        uint32_t depth) {
  std::map<std::pair<uint32_t, uint32_t>, float> out;
  size_t wrong = 0;
  for (const wt_reception& r : list) {
    const uint32_t i = r.node - 1000;
    REQUIRE(i < c.rays.size());
    wrong += r.sample != c.rays[i].sample || r.transmitter != c.rays[i].transmitter || r.depth != depth;
    wrong += !out.emplace(std::pair{i, r.receiver}, r.distance_m).second;  // listed twice
  }
  CHECK(wrong == 0);
  return out;
}

void compare(const Case& c) {
  Receive receive(context(), c.radius_m);
  receive(c.ends(), upload_labelled(c.rays), upload_hits_of(c.rays), 4);
  const auto found = pairs_of(c, receive.list(), 4);
  size_t expected = 0, lost = 0, spurious = 0, far = 0;
  for (uint32_t i = 0; i < c.rays.size(); ++i)
    for (uint32_t r = 0; r < c.receivers.size(); ++r) {
      const double apart = nearest(c.rays[i], c.receivers[r]).apart;
      const auto at = found.find({i, r});
      const bool inside = c.wanted(c.rays[i].transmitter, r) && apart <= c.radius_m;
      expected += inside;
      if (at != found.end()) far += std::abs(double{at->second} - apart) > rounding_m;
      if (std::abs(apart - c.radius_m) < rounding_m) continue;
      lost += inside && at == found.end();
      spurious += !inside && at != found.end();
    }
  CHECK(lost == 0);
  CHECK(spurious == 0);
  CHECK(far == 0);
  if (c.rays.size() * c.receivers.size() > 2000) CHECK(expected > 20);
}

}  // namespace

TEST_CASE("a ray is received where its segment comes within the radius, and a wanted link alone") {
  for (const uint32_t receivers : {1u, 15u, 16u, 17u, 40u}) {
    CAPTURE(receivers);
    compare(random_case(300, receivers, receivers));
  }
  compare(random_case(1, 1, 9));
}

TEST_CASE("the end of a segment, its beginning, and what lies beyond either") {
  Case c;
  c.transmitters = {{0, 0, 0}};
  c.receivers = {{5, 1.5, 0}, {10.5, 0, 0}, {12.5, 0, 0}, {-1, 0, 0}, {-2.5, 0, 0}, {5, 2.5, 0}};
  for (uint32_t r = 0; r < c.receivers.size(); ++r) c.links.push_back({0, r});
  c.rays = {{{{0, 0, 0}, {1, 0, 0}, WT_NONE, 1000}, 0, 0, {10, 3, 1}},
            {{{0, 0, 0}, {1, 0, 0}, WT_NONE, 1001}, 1, 0, {}}};
  Receive receive(context(), 2);
  receive(c.ends(), upload_labelled(c.rays), upload_hits_of(c.rays), 0);
  std::set<std::pair<uint32_t, uint32_t>> found;
  for (const auto& [pair, distance_m] : pairs_of(c, receive.list(), 0)) found.insert(pair);
  // The first ray ends at x = 10: receiver 2 is behind that wall, 2.5 m away. The second goes on through it.
  CHECK(found == std::set<std::pair<uint32_t, uint32_t>>{{0, 0}, {0, 1}, {0, 3}, {1, 0}, {1, 1}, {1, 2}, {1, 3}});
}

TEST_CASE("two receivers and many transmitters: each ray is received on the links of its own transmitter") {
  Case c;
  c.receivers = {{10, 0, 0}, {20, 0, 0}};
  constexpr uint32_t transmitters = 40;
  for (uint32_t t = 0; t < transmitters; ++t) {
    c.transmitters.push_back({0, 0, 0.01 * t});
    for (uint32_t r = 0; r < 2; ++r)
      if (t % 4 == r || t % 4 == 2) c.links.push_back({t, r});  // one of them, both, or none
    c.rays.push_back({ray_towards(c.transmitters.back(), {1, 0, 0}), t, t, {}});
    c.rays.back().ray.node = 1000 + t;
  }
  Receive receive(context(), 1);
  receive(c.ends(), upload_labelled(c.rays), upload_hits_of(c.rays), 0);
  std::vector<Link> found;
  for (const wt_reception& r : receive.list()) found.push_back({r.transmitter, r.receiver});
  std::ranges::sort(found);
  CHECK(found == c.links);
}

TEST_CASE("a list that is too short grows, and keeps what earlier depths have found") {
  Case c = random_case(1500, 64, 5);
  c.radius_m = 100;  // everything is inside
  c.links.clear();
  for (uint32_t t = 0; t < 3; ++t)
    for (uint32_t r = 0; r < 64; ++r) c.links.push_back({t, r});
  const RayQueue queue = upload_labelled(c.rays);
  const HitList hits = upload_hits_of(c.rays);
  Receive receive(context(), c.radius_m);
  for (uint32_t depth = 0; depth < 2; ++depth) receive(c.ends(), queue, hits, depth);
  const std::vector<wt_reception> list = receive.list();
  CHECK(list.size() == size_t{2} * 1500 * 64);  // more than the first list holds, from the first depth on
  std::vector<wt_reception> by_depth[2];
  for (const wt_reception& r : list) by_depth[r.depth].push_back(r);
  for (uint32_t depth = 0; depth < 2; ++depth) CHECK(pairs_of(c, by_depth[depth], depth).size() == size_t{1500} * 64);
  receive.begin_batch();
  CHECK(receive.list().empty());
}

TEST_CASE("rays that a cache answered pass the receiver that it says, however far; the others are tested") {
  const Case c = random_case(300, 20, 8);
  Random random(3);
  std::vector<float> traced(c.rays.size());
  std::vector<uint32_t> answers(c.rays.size(), WT_NONE);
  std::map<std::pair<uint32_t, uint32_t>, double> expected;
  for (uint32_t i = 0; i < c.rays.size(); ++i) {
    const bool answered = i % 3 == 0;
    traced[i] = std::bit_cast<float>(answered ? WT_NONE : i);
    if (answered && i % 2 == 0) answers[i] = random.below(20);
    for (uint32_t r = 0; r < 20; ++r) {
      const double apart = nearest(c.rays[i], c.receivers[r]).apart;
      const bool heard = answered ? answers[i] == r : c.wanted(c.rays[i].transmitter, r) && apart <= c.radius_m;
      if (heard) expected[{i, r}] = apart;
    }
  }
  Receive receive(context(), c.radius_m);
  receive(c.ends(), upload_labelled(c.rays), upload_hits_of(c.rays), 2, context().buffer(traced, "traced"),
          context().buffer(answers, "answers"));
  const auto found = pairs_of(c, receive.list(), 2);
  REQUIRE(found.size() == expected.size());
  double worst = 0;
  for (const auto& [pair, distance_m] : found) {
    REQUIRE(expected.contains(pair));
    worst = std::max(worst, std::abs(double{distance_m} - expected[pair]));
  }
  CHECK(worst < rounding_m);
  CHECK(found.size() > 50);
}

TEST_CASE("the first receiver is the one whose sphere the ray enters first") {
  for (const uint32_t receivers : {1u, 16u, 37u}) {
    CAPTURE(receivers);
    const Case c = random_case(400, receivers, 20 + receivers);
    gpu::Buffer<uint32_t> first = context().buffer<uint32_t>(c.rays.size(), "first receivers");
    Receive receive(context(), c.radius_m);
    receive.first(c.ends(), upload_labelled(c.rays), upload_hits_of(c.rays), first);
    const std::vector<uint32_t> found = first.read();
    size_t wrong = 0, heard = 0;
    for (uint32_t i = 0; i < c.rays.size(); ++i) {
      // Entry into the sphere around the nearest point of the segment, by Pythagoras.
      const auto entry = [&](uint32_t r) -> std::optional<double> {
        const Nearest n = nearest(c.rays[i], c.receivers[r]);
        if (!c.wanted(c.rays[i].transmitter, r) || n.apart > c.radius_m) return std::nullopt;
        return n.along - std::sqrt(c.radius_m * c.radius_m - n.apart * n.apart);
      };
      std::optional<double> earliest;
      for (uint32_t r = 0; r < receivers; ++r)
        if (const auto e = entry(r); e && (!earliest || *e < *earliest)) earliest = e;
      heard += earliest.has_value();
      const std::optional<double> said = found[i] == WT_NONE ? std::nullopt : entry(found[i]);
      // Near the rim the root magnifies rounding.
      wrong += earliest.has_value() != said.has_value() || (earliest && std::abs(*earliest - *said) > 0.02);
    }
    CHECK(wrong == 0);
    CHECK(heard > receivers);
  }
}
