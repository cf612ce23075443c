// SPDX-License-Identifier: Apache-2.0
// hear: the listeners that rays pass, against many points on every segment; chains are turned around, and end with the
// edge that the ray came from.
#include "passes/hear.hpp"

#include <doctest/doctest.h>

#include <map>
#include <set>

#include "passes/exact.hpp"
#include "passes/labelled.hpp"
#include "passes/triangles.hpp"
#include "passes/wedge_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t edge_roots = 40, edge_count = 5, listener_roots = 2;
constexpr float hearing_margin_m = 1.5f;

struct Squares {
  double x_m, y_m, size_m;
  uint32_t columns, rows;
  std::vector<uint32_t> listeners;
  std::vector<float> heights;

  ListenerMap on_device() const {
    float low = 1e9f, high = -1e9f;
    for (size_t i = 0; i < listeners.size(); ++i)
      if (listeners[i] != WT_NONE) low = std::min(low, heights[2 * i]), high = std::max(high, heights[2 * i + 1]);
    return {.listeners = context().buffer(listeners, "listeners"),
            .heights = context().buffer(heights, "heights"),
            .x_m = static_cast<float>(x_m),
            .y_m = static_cast<float>(y_m),
            .size_m = static_cast<float>(size_m),
            .columns = columns,
            .rows = rows,
            .low_m = low,
            .high_m = high};
  }
};

// Four of five squares have a listener.
Squares random_squares(Random& random) {
  Squares out{-9, -7.5, 2.5, 7, 6, {}, {}};
  uint32_t next = 0;
  for (uint32_t i = 0; i < out.columns * out.rows; ++i) {
    out.listeners.push_back(random() < 0.2 ? WT_NONE : next++);
    const auto low = static_cast<float>(random.between(0, 3));
    out.heights.insert(out.heights.end(), {low, low + static_cast<float>(random.between(0, 1))});
  }
  return out;
}

struct Case {
  std::vector<Sequence> sequences;  // those of the rays, with edges as transmitters
  std::vector<LabelledRay> rays;
};

// The node of a sequence in a trie that was read.
uint32_t node_of(const std::vector<uint64_t>& table, const Sequence& s) {
  for (uint32_t slot = 0; slot < table.size(); ++slot)
    if (table[slot] != WT_EMPTY && sequence_of(table, slot) == s) return slot;
  return WT_NONE;
}

// Makes random segments through the squares, a third of them without an end; some have met nothing yet.
Case random_case(const std::vector<uint64_t>& met, const std::vector<Sequence>& known, uint32_t count, Random& random) {
  Case out;
  for (uint32_t i = 0; i < count; ++i) {
    Sequence s = random() < 0.2 ? Sequence{edge_roots + random.below(edge_count), {}}
                                : known[random.below(static_cast<uint32_t>(known.size()))];
    const uint32_t node = s.surfaces.empty() ? WT_ROOT | s.transmitter : node_of(met, s);
    const glm::dvec3 to{random.between(-9, 8.5), random.between(-7.5, 7.5), random.between(0, 4)};
    const glm::dvec3 from = random.in_cube(14);
    LabelledRay ray{ray_towards(from, glm::normalize(to - from)), i, 0, {}};
    ray.ray.node = node | random.below(4) << WT_QUARTER_SHIFT;
    if (random() < 0.67) ray.hit = {static_cast<float>(random.between(0, 25)), 5, 2};
    out.sequences.push_back(std::move(s));
    out.rays.push_back(ray);
  }
  return out;
}

// The sequence that a listener hears of a ray that has met this one.
Sequence heard_by(uint32_t listener, const Sequence& met) {
  Sequence out{listener_roots + listener, {met.surfaces.rbegin(), met.surfaces.rend()}};
  out.surfaces.push_back(WT_HEARD_WEDGE | (met.transmitter - edge_roots));
  return out;
}

// The sequences that are heard at points of every segment. beyond_m: points outside of a listener's box by as much
// count, too; where it is negative, points are inside by that.
SequenceSet expected(const Squares& squares, const Case& c, double beyond_m) {
  SequenceSet out;
  for (size_t i = 0; i < c.rays.size(); ++i) {
    const glm::dvec3 o = to_double(c.rays[i].ray.origin), d = to_double(c.rays[i].ray.direction);
    const double length = c.rays[i].hit.missed() ? 60 : static_cast<double>(c.rays[i].hit.t);
    const auto passes = [&](uint32_t square) {
      const double x = squares.x_m + square % squares.columns * squares.size_m;
      const double y = squares.y_m + square / squares.columns * squares.size_m;
      const double low = double{squares.heights[2 * square]} - hearing_margin_m;
      const double high = double{squares.heights[2 * square + 1]} + hearing_margin_m;
      for (int step = 0; step <= 4000; ++step) {
        const glm::dvec3 p = o + length * step / 4000.0 * d;
        if (p.x >= x - beyond_m && p.x <= x + squares.size_m + beyond_m && p.y >= y - beyond_m &&
            p.y <= y + squares.size_m + beyond_m && p.z >= low - beyond_m && p.z <= high + beyond_m)
          return true;
      }
      return false;
    };
    for (uint32_t square = 0; square < squares.listeners.size(); ++square)
      if (squares.listeners[square] != WT_NONE && passes(square))
        out.insert(heard_by(squares.listeners[square], c.sequences[i]));
  }
  return out;
}

}  // namespace

TEST_CASE("listeners hear the rays that pass them, with what these have met, the last surface first") {
  Random random(11);
  const DeviceScene scene = make_device_scene(context(), box_and_panels(), false, 100);
  std::vector<Sequence> known;
  for (uint32_t edge = 0; edge < edge_count; ++edge)
    for (const std::vector<uint32_t>& surfaces : {std::vector<uint32_t>{3}, {edge}, {edge, 6, 2}, {7, 1, 7}})
      known.push_back({edge_roots + edge, surfaces});
  Sequences met(context(), 1 << 10);
  met.clear();
  enter(met, scene, known, 3);
  const std::vector<uint64_t> table = met.table().read();
  for (int round = 0; round < 4; ++round) {
    CAPTURE(round);
    const Squares squares = random_squares(random);
    const Case c = random_case(table, known, 60, random);
    Sequences set(context(), 64);
    set.clear();
    Hear hear(context(), edge_roots, listener_roots, hearing_margin_m);
    const ListenerMap map = squares.on_device();
    const RayQueue rays = upload_labelled(c.rays);
    const HitList hits = upload_hits_of(c.rays);
    int grown = 0;
    for (hear(rays, hits, met.table(), map, set.trie()); set.overflowed(); ++grown) {
      set.regrow(4);
      hear(rays, hits, met.table(), map, set.trie());
    }
    CHECK(grown > 0);
    const std::vector<uint64_t> heard = set.table().read();
    SequenceSet found;
    for (uint32_t slot = 0; slot < heard.size(); ++slot)
      if (heard[slot] != WT_EMPTY && static_cast<uint32_t>(heard[slot]) & WT_HEARD_WEDGE)
        found.insert(sequence_of(heard, slot));
    const SequenceSet sure = expected(squares, c, -0.002), allowed = expected(squares, c, 0.02);
    CHECK(sure.size() > 50);
    for (const Sequence& s : sure) CHECK(found.contains(s));
    for (const Sequence& s : found) CHECK(allowed.contains(s));
    // The rays' quarters are kept.
    const std::vector<uint32_t> quarters = set.quarters().read();
    for (uint32_t slot = 0; slot < heard.size(); ++slot)
      if (heard[slot] != WT_EMPTY && static_cast<uint32_t>(heard[slot]) & WT_HEARD_WEDGE)
        CHECK((quarters[slot] & WT_ALL_QUARTERS) != 0);
  }
}
