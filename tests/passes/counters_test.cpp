// SPDX-License-Identifier: Apache-2.0
// Counters: lengths that are read, lengths that are foreseen, and the test whether a frame was as foreseen.
#include "passes/counters.hpp"

#include <doctest/doctest.h>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr size_t list_room = 1 << 20;

void count_to(Counters& counters, uint32_t candidates, uint32_t solved) {
  counters.restart(&wt_counters::candidates, candidates, Stage::transfer);
  counters.restart(&wt_counters::solved, solved, Stage::transfer);
}

// Runs a frame with two lists; returns whether it was as foreseen.
bool settles(Counters& counters, bool foresee, uint32_t candidates, uint32_t solved, size_t capacity = list_room) {
  counters.foresee(foresee);
  counters.zero();
  count_to(counters, candidates, solved);
  const uint32_t first = counters.length(&wt_counters::candidates, capacity, Stage::transfer);
  const uint32_t second = counters.length(&wt_counters::solved, capacity, Stage::transfer);
  if (!counters.foresees()) {
    CHECK(first == candidates);
    CHECK(second == solved);
  }
  CHECK(first <= std::max<size_t>(capacity, candidates));
  return counters.settle(counters.read(Stage::transfer));
}

}  // namespace

TEST_CASE("each counter by its word") {
  CHECK(counter_word(&wt_counters::nodes) == 0);
  CHECK(counter_word(&wt_counters::candidates) == offsetof(wt_counters, candidates) / 4);
  Counters counters(context());
  count_to(counters, 7, 9);
  counters.restart_nodes(5, Stage::transfer);
  wt_counters now = counters.read(Stage::transfer);
  CHECK(now.candidates == 7);
  CHECK(now.solved == 9);
  CHECK(now.nodes == 5);
  CHECK(now.exchanged == 0);
  CHECK(now.visible == 0);
  counters.restart_ended(Stage::transfer);
  counters.zero();
  now = counters.read(Stage::transfer);
  CHECK(now.candidates == 0);
}

TEST_CASE("nothing is foreseen before a frame has settled; then lengths are bounds with room") {
  Counters counters(context());
  counters.foresee(true);
  CHECK(!counters.foresees());
  CHECK(settles(counters, true, 10'000, 300));
  counters.foresee(true);
  CHECK(counters.foresees());
  counters.zero();
  CHECK(counters.length(&wt_counters::candidates, list_room, Stage::transfer) >= 12'500);
  CHECK(counters.length(&wt_counters::candidates, 11'000, Stage::transfer) ==
        11'000);  // limited to the room of the list
  CHECK(counters.last().candidates == 10'000);
}

TEST_CASE("a frame with more than was foreseen does not settle, and the next one foresees it") {
  Counters counters(context());
  REQUIRE(settles(counters, false, 10'000, 300));
  CHECK(settles(counters, true, 12'000, 1'200));
  CHECK(!settles(counters, true, 12'000, 9'000));  // one list is enough
  CHECK(counters.last().solved == 1'200);
  // It is read, since a frame that did not settle is repeated. A surface that hides paths during the first try hides
  // them from the start in the second: counts may be lower then, and yet the next frame needs the room of the first.
  CHECK(settles(counters, false, 12'000, 2'000));
  CHECK(settles(counters, true, 12'000, 9'000));
  // A list that is too small for its content does not settle either.
  CHECK(!settles(counters, true, 12'000, 9'000, 8'500));
}

TEST_CASE("a full set of sequences does not settle where lengths are foreseen") {
  Counters counters(context());
  REQUIRE(settles(counters, false, 100, 100));
  counters.foresee(true);
  counters.zero();
  counters.restart(&wt_counters::trie_overflow, 1, Stage::transfer);
  CHECK(!counters.settle(counters.read(Stage::transfer)));
}
