// SPDX-License-Identifier: Apache-2.0
// sequences: the trie is a set for every size of its table: compared with std::set, small and full tables, exchanges.
// Sequences are invented; no ray is traced.
#include "passes/sequences.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "passes/made_sequences.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t surface_count = 30;

std::vector<Sequence> random_sequences(size_t count, uint32_t seed) {
  Random random(seed);
  std::vector<Sequence> out(count);
  for (Sequence& s : out) {
    s.transmitter = random.below(made_transmitters);
    s.surfaces.resize(random.below(made_depth + 1));
    // Squaring makes some surfaces much more frequent than others, as in a scene.
    for (uint32_t& surface : s.surfaces) surface = static_cast<uint32_t>(std::pow(random(), 2) * surface_count);
  }
  return out;
}

}  // namespace

TEST_CASE("a new set is empty: the roots alone are listed") {
  Sequences set(context(), 1024);
  CHECK(set.collect(made_transmitters) == made_transmitters);
  CHECK(contents(set, made_transmitters) == SequenceSet{});
  CHECK_FALSE(set.overflowed());
}

TEST_CASE("the set holds every prefix once, as std::set does, and clear empties it") {
  const DeviceScene scene = scene_of_floors(surface_count);
  Sequences set(context(), 16384);
  for (const uint32_t seed : {1u, 2u}) {
    const std::vector<Sequence> sequences = random_sequences(900, seed);
    enter_once(set, scene, sequences);
    CHECK_FALSE(set.overflowed());
    CHECK(contents(set, made_transmitters) == with_prefixes(sequences));
    enter_once(set, scene, sequences);  // again: nothing new
    CHECK(contents(set, made_transmitters) == with_prefixes(sequences));
    set.clear();
    CHECK(contents(set, made_transmitters) == SequenceSet{});
  }
}

TEST_CASE("growth keeps every chain") {
  const DeviceScene scene = scene_of_floors(surface_count);
  const std::vector<Sequence> sequences = random_sequences(150, 3);
  Sequences set(context(), 1024);
  enter_once(set, scene, sequences);
  REQUIRE_FALSE(set.overflowed());
  set.regrow(made_depth);
  CHECK(set.table().size() == 4096);
  CHECK_FALSE(set.overflowed());
  CHECK(contents(set, made_transmitters) == with_prefixes(sequences));
}

TEST_CASE("a table that is far too small overflows, says so, and grows to the same set") {
  const DeviceScene scene = scene_of_floors(surface_count);
  const std::vector<Sequence> sequences = random_sequences(900, 4);
  Sequences set(context(), 64);
  enter_once(set, scene, sequences);
  CHECK(set.overflowed());
  enter(set, scene, sequences, made_depth);
  CHECK_FALSE(set.overflowed());
  CHECK(set.table().size() >= with_prefixes(sequences).size());
  CHECK(contents(set, made_transmitters) == with_prefixes(sequences));
}

TEST_CASE("what follows a prefix that found no slot is not entered") {
  // 970 first surfaces crowd the table: some find no slot near theirs, while others are free elsewhere. Only the last
  // continue, and a sequence after one that found no slot would have no parent.
  const DeviceScene scene = scene_of_floors(1000);
  std::vector<Sequence> sequences;
  for (uint32_t a = 0; a < 970; ++a) sequences.push_back({a % 3, {a}});
  for (uint32_t a = 930; a < 970; ++a) sequences[a].surfaces = {a, a + 1, a + 2};
  Sequences set(context(), 1024);
  enter_once(set, scene, sequences);
  REQUIRE(set.overflowed());
  size_t orphans = 0;
  for (const uint64_t key : set.table().read()) orphans += key != WT_EMPTY && (key >> 32) == WT_NONE;
  CHECK(orphans == 0);
  set.regrow(made_depth);
  const auto held = contents(set, made_transmitters);
  REQUIRE(held.has_value());
  const SequenceSet all = with_prefixes(sequences);
  CHECK(std::includes(all.begin(), all.end(), held->begin(), held->end()));
}

TEST_CASE("the list of nodes grows with the set") {
  const DeviceScene scene = scene_of_floors(surface_count);
  const std::vector<Sequence> sequences = random_sequences(3000, 5);
  Sequences set(context(), 32768);
  enter(set, scene, sequences, made_depth);
  const size_t expected = with_prefixes(sequences).size() + made_transmitters;
  REQUIRE(expected > 4096);  // more than the list begins with
  CHECK(set.collect(made_transmitters) == expected);
}

TEST_CASE("commute enters the exchanges of neighbouring perpendicular surfaces, and nothing else") {
  // 0, 1: walls across x; 2: a wall across y; 3: the ground; 4: askew; 5: leaning by 0.01 from perpendicular to the
  // ground.
  const std::vector<Float3> normals{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6f, 0, 0.8f}, {0, 0.99995f, 0.01f}};
  const DeviceScene scene = scene_of_normals(normals);
  const auto perpendicular = [&](uint32_t a, uint32_t b) {
    double dot = 0;
    for (size_t axis = 0; axis < 3; ++axis) dot += double{normals[a][axis]} * normals[b][axis];
    return std::abs(dot) < 0.015;
  };
  std::vector<Sequence> sequences;
  Random random(6);
  for (int i = 0; i < 60; ++i) {
    Sequence s{random.below(2), {}};
    for (uint32_t length = 1 + random.below(4); s.surfaces.size() < length;) {
      const uint32_t surface = random.below(6);
      if (s.surfaces.empty() || s.surfaces.back() != surface) s.surfaces.push_back(surface);
    }
    sequences.push_back(s);
  }
  std::vector<Sequence> expected = sequences;
  for (const Sequence& s : with_prefixes(sequences))
    for (size_t k = 0; k + 1 < s.surfaces.size(); ++k) {
      if (!perpendicular(s.surfaces[k], s.surfaces[k + 1])) continue;
      Sequence swapped = s;
      std::swap(swapped.surfaces[k], swapped.surfaces[k + 1]);
      // A surface never follows itself.
      if (std::adjacent_find(swapped.surfaces.begin(), swapped.surfaces.end()) != swapped.surfaces.end()) continue;
      expected.push_back(swapped);
    }
  for (const uint64_t slots : {uint64_t{4096}, uint64_t{128}}) {  // the second must grow on the way
    CAPTURE(slots);
    Sequences set(context(), slots);
    enter(set, scene, sequences, 4);
    REQUIRE(contents(set, 2) == with_prefixes(sequences));
    const uint32_t count =
        set.extend(set.collect(2), 4, [&](const Sequences::Found& found) { set.commute(scene.surfaces, found); });
    const auto listed = [&](uint32_t length) {
      std::vector<uint32_t> nodes = set.nodes().read(0, length);
      std::ranges::sort(nodes);
      return nodes;
    };
    const std::vector<uint32_t> after_exchanges = listed(count);
    CHECK((listed(set.collect(2)) == after_exchanges));  // new sequences are listed once
    CHECK(contents(set, 2) == with_prefixes(expected));
  }
}

TEST_CASE(
    "what an exchange finds is found by who found its source, not by whom other exchanges lead on; growth keeps it") {
  // Walls across x and y and the ground: all neighbours exchange, and exchanges of exchanges are there, too.
  const DeviceScene scene = scene_of_normals({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const std::vector<Sequence> sequences{{0, {0, 1, 2}}, {0, {1, 0, 2}}, {0, {2, 1, 0}}};
  for (const uint64_t slots : {uint64_t{1024}, uint64_t{16}}) {  // the second must grow on the way
    CAPTURE(slots);
    Sequences set(context(), slots);
    enter(set, scene, sequences, 3);
    // The rays of these sequences were of quarters 0, 1 and 2.
    const auto nodes = [&] {
      std::map<std::vector<uint32_t>, uint32_t> out;
      const std::vector<uint64_t> table = set.table().read();
      for (uint32_t slot = 0; slot < table.size(); ++slot)
        if (table[slot] != WT_EMPTY) {
          std::vector<uint32_t> surfaces;
          for (uint32_t n = slot; !(n & WT_ROOT); n = static_cast<uint32_t>(table[n] >> 32))
            surfaces.insert(surfaces.begin(), static_cast<uint32_t>(table[n]));
          out[surfaces] = slot;
        }
      return out;
    };
    std::vector<uint32_t> bits(set.table().size(), 0);
    for (const auto& [surfaces, slot] : nodes())
      for (uint32_t q = 0; q < 3; ++q)
        if (std::equal(surfaces.begin(), surfaces.end(), sequences[q].surfaces.begin())) bits[slot] |= 1u << q;
    set.quarters().write(bits);
    set.extend(set.collect(1), 3, [&](const Sequences::Found& found) { set.commute(scene.surfaces, found); });
    const std::vector<uint32_t> quarters = set.quarters().read();
    const auto all = nodes();
    const auto found_by = [&](const std::vector<uint32_t>& surfaces) {
      const uint32_t word = quarters[all.at(surfaces)];
      return (word | word >> 4) & WT_ALL_QUARTERS;
    };
    CHECK(found_by({0, 1, 2}) == 0b011);  // itself, and the exchange of 1 0 2
    CHECK(found_by({1, 0, 2}) == 0b011);
    CHECK(found_by({0, 2, 1}) == 0b001);  // one exchange from 0 1 2, two from the others
    CHECK(found_by({1, 2, 0}) == 0b110);  // one from 1 0 2 and from 2 1 0
    CHECK(found_by({2, 1, 0}) == 0b100);
    CHECK(found_by({2, 0, 1}) == 0b100);
    CHECK(found_by({1, 2}) == 0b110);  // quarters of the prefix of 1 2 0, and exchanged from 2 1
  }
}
