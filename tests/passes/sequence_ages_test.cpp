// SPDX-License-Identifier: Apache-2.0
// sequences from frame to frame: ages, forgotten and kept sequences, against a std::map of sequences to frames.
// Sequences are invented; no ray is traced.
#include <doctest/doctest.h>

#include <functional>
#include <map>

#include "passes/made_sequences.hpp"
#include "passes/sequences.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Sends rays through these sequences in this frame, as enter() does, in a set that keeps ages.
void meet(Sequences& set, const DeviceScene& scene, const std::vector<Sequence>& sequences) {
  Scan scan(context());
  Interact interact(context(), {.ages = true});
  std::vector<Ray> rays;
  for (const Sequence& s : sequences) rays.push_back({{}, {1, 0, 0}, WT_NONE, WT_ROOT | s.transmitter});
  for (;; set.regrow(made_depth)) {
    RayQueue queue = upload(rays), next = upload(rays);
    std::vector<Sequence> alive = sequences;
    for (size_t depth = 0; queue.count > 0; ++depth) {
      std::vector<uint32_t> surfaces;
      for (const Sequence& s : alive) surfaces.push_back(depth < s.surfaces.size() ? s.surfaces[depth] : WT_NONE);
      std::erase_if(alive, [&](const Sequence& s) { return s.surfaces.size() <= depth; });
      HitList hits = upload_hits(surfaces, rays.size());
      const uint32_t count = scan(hits.block_hits, hits.blocks(queue.count));
      interact(scene, queue, hits, count, set.trie(), {.reflected = &next});
      std::swap(queue, next);
    }
    if (!set.overflowed()) return;
  }
}

// The required content of a set that keeps ages: every sequence with its age, twice the last frame that met it, and one
// more if a ray did.
using Aged = std::map<Sequence, uint32_t>;

void renew(Aged& known, const std::vector<Sequence>& sequences, uint32_t age) {
  for (const Sequence& s : with_prefixes(sequences)) known[s] = std::max(known[s], age);
}

void renew_by_rays(Aged& known, const std::vector<Sequence>& sequences, uint32_t frame) {
  renew(known, sequences, 2 * frame + 1);
}

size_t erase_older(Aged& known, uint32_t frame) {
  return std::erase_if(known, [&](const auto& s) { return s.second / 2 < frame; });
}

Aged aged_contents(Sequences& set) {
  const uint32_t count = set.collect(made_transmitters);
  const std::vector<uint32_t> nodes = set.nodes().read(0, count), ages = set.ages()->read();
  const std::vector<uint64_t> table = set.table().read();
  Aged out;
  for (uint32_t i = made_transmitters; i < count; ++i) {
    Sequence s;
    uint32_t node = nodes[i];
    for (; !(node & WT_ROOT); node = static_cast<uint32_t>(table[node] >> 32))
      s.surfaces.insert(s.surfaces.begin(), static_cast<uint32_t>(table[node]));
    s.transmitter = node & ~WT_ROOT;
    out[s] = ages[nodes[i]];
  }
  return out;
}

// Returns every exchange of two adjacent perpendicular surfaces of a sequence.
std::vector<Sequence> exchanges(const Sequence& s, const std::function<bool(uint32_t, uint32_t)>& perpendicular) {
  std::vector<Sequence> out;
  for (size_t k = 0; k + 1 < s.surfaces.size(); ++k) {
    if (!perpendicular(s.surfaces[k], s.surfaces[k + 1])) continue;
    Sequence swapped = s;
    std::swap(swapped.surfaces[k], swapped.surfaces[k + 1]);
    // A surface never follows itself.
    if (std::adjacent_find(swapped.surfaces.begin(), swapped.surfaces.end()) == swapped.surfaces.end())
      out.push_back(swapped);
  }
  return out;
}

// Sequences of surfaces 0 .. below - 1, none of which follows itself.
std::vector<Sequence> likely_sequences(size_t count, uint32_t below, Random& random) {
  std::vector<Sequence> out(count);
  for (Sequence& s : out) {
    s.transmitter = random.below(made_transmitters);
    for (uint32_t length = 1 + random.below(made_depth); s.surfaces.size() < length;) {
      const uint32_t surface = random.below(below);
      if (s.surfaces.empty() || s.surfaces.back() != surface) s.surfaces.push_back(surface);
    }
  }
  return out;
}

}  // namespace

TEST_CASE("ages: the last frame that met a sequence, its prefixes included, whatever the table's size") {
  const DeviceScene scene = scene_of_floors(8);
  for (const uint64_t slots : {uint64_t{8192}, uint64_t{64}}) {  // the second grows on the way
    CAPTURE(slots);
    Sequences set(context(), slots, true);
    Aged known;
    Random random(8);
    for (int frame = 0; frame < 6; ++frame) {
      set.begin_frame();
      const std::vector<Sequence> sequences = likely_sequences(80, 6, random);
      meet(set, scene, sequences);
      renew_by_rays(known, sequences, set.frame());
      CHECK(aged_contents(set) == known);
    }
    set.regrow(made_depth);
    CHECK(aged_contents(set) == known);
  }
}

TEST_CASE("forget drops what is older than so many frames, and keeps every prefix of the rest") {
  const DeviceScene scene = scene_of_floors(8);
  Sequences set(context(), 1024, true);
  Aged known;
  Random random(10);
  size_t dropped = 0;
  for (int frame = 0; frame < 12; ++frame) {
    CAPTURE(frame);
    set.begin_frame();
    const std::vector<Sequence> sequences = likely_sequences(30, 8, random);
    meet(set, scene, sequences);
    renew_by_rays(known, sequences, set.frame());
    if (frame == 6) set.regrow(made_depth);
    set.forget(3, made_depth);
    if (set.frame() > 3) dropped += erase_older(known, set.frame() - 3);
    CHECK(aged_contents(set) == known);
  }
  CHECK(dropped > 200);
  set.begin_frame();
  set.forget(1, made_depth);
  erase_older(known, set.frame() - 1);
  CHECK(aged_contents(set) == known);
  for (int frame = 0; frame < 3; ++frame) set.begin_frame();
  set.forget(1, made_depth);
  CHECK(aged_contents(set).empty());
}

TEST_CASE("commute with ages: the exchanges of what this frame's rays have met, and of nothing else") {
  // Three walls across x, three across y and the ground: nearly all neighbours commute.
  const std::vector<Float3> normals{{1, 0, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, 1}};
  const DeviceScene scene = scene_of_normals(normals);
  const auto perpendicular = [](uint32_t a, uint32_t b) { return a / 3 != b / 3; };
  for (const uint64_t slots : {uint64_t{16384}, uint64_t{256}}) {  // the second grows on the way
    CAPTURE(slots);
    Sequences set(context(), slots, true);
    Aged known;
    Random random(12);
    for (int frame = 0; frame < 5; ++frame) {
      CAPTURE(frame);
      set.begin_frame();
      const std::vector<Sequence> sequences = likely_sequences(25, 7, random);
      meet(set, scene, sequences);
      renew_by_rays(known, sequences, set.frame());
      std::vector<Sequence> entered;
      for (const auto& [s, age] : known) {
        if (age != 2 * set.frame() + 1) continue;
        const std::vector<Sequence> more = exchanges(s, perpendicular);
        entered.insert(entered.end(), more.begin(), more.end());
      }
      set.extend(set.collect(made_transmitters), made_depth,
                 [&](const Sequences::Found& found) { set.commute(scene.surfaces, found); });
      renew(known, entered, 2 * set.frame());
      const Aged got = aged_contents(set);
      CHECK(got.size() == known.size());
      CHECK(got == known);
    }
  }
}

TEST_CASE("keep renews the sequences of visible solved paths with their prefixes, and of no others") {
  const DeviceScene scene = scene_of_floors(8);
  Sequences set(context(), 4096, true);
  Random random(14);
  const std::vector<Sequence> sequences = likely_sequences(100, 8, random);
  set.begin_frame();
  meet(set, scene, sequences);
  Aged known;
  renew_by_rays(known, sequences, set.frame());
  set.begin_frame();

  // Every fourth sequence is solved, every other of those blocked.
  const uint32_t count = set.collect(made_transmitters);
  const std::vector<uint32_t> nodes = set.nodes().read(0, count);
  const std::vector<uint64_t> table = set.table().read();
  SolvedList solved;
  solved.max_depth = made_depth;
  std::vector<wt_solved> headers{
      {.transmitter = 1, .receiver = 0, .depth = 0, .blocked = 0, .node = WT_ROOT | 1, .quarters = WT_ALL_QUARTERS}};
  std::vector<uint32_t> surfaces(made_depth, WT_NONE);
  std::vector<Sequence> visible;
  for (uint32_t i = made_transmitters; i < count; i += 4) {
    Sequence s;
    uint32_t node = nodes[i];
    for (; !(node & WT_ROOT); node = static_cast<uint32_t>(table[node] >> 32))
      s.surfaces.insert(s.surfaces.begin(), static_cast<uint32_t>(table[node]));
    s.transmitter = node & ~WT_ROOT;
    const bool blocked = i % 8 == 0;
    headers.push_back({s.transmitter, 0, static_cast<uint32_t>(s.surfaces.size()), blocked, nodes[i], WT_ALL_QUARTERS});
    if (!blocked) visible.push_back(s);
    s.surfaces.resize(made_depth, WT_NONE);
    surfaces.insert(surfaces.end(), s.surfaces.begin(), s.surfaces.end());
  }
  REQUIRE(visible.size() > 20);
  solved.headers = context().buffer(headers, "solved");
  solved.sequences = context().buffer(surfaces, "sequences of solved");
  solved.count = static_cast<uint32_t>(headers.size());
  set.keep(solved);
  renew(known, visible, 2 * set.frame());
  CHECK(aged_contents(set) == known);
}
