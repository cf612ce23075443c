// SPDX-License-Identifier: Apache-2.0
// Counters: lengths that are read, lengths that are foreseen, and the test whether a frame was as foreseen.
#include "passes/counters.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr size_t list_room = 1 << 20;

void count_to(Counters& counters, uint32_t candidates, uint32_t solved) {
  counters.restart(&wt_counters::candidates, candidates, Stage::transfer);
  counters.restart(&wt_counters::solved, solved, Stage::transfer);
}

// The lengths of two lists in a run of the passes.
struct Lists {
  uint32_t candidates, solved;
};

struct CountedFrames {
  std::vector<bool> foresaw;  // for each run
  std::vector<Lists> told;    // by length(), in each run
};

// Runs a frame whose lists are `first`, and `again` if it runs once more. Lengths that are read must be the true ones.
CountedFrames run_frame(Counters& counters, bool alike, Lists first, Lists again, size_t capacity = list_room) {
  CountedFrames out;
  const wt_counters end = counters.settled(
      alike, Stage::transfer, [&] { return counters.zero(); },
      [&] {
        const Lists& lists = out.told.empty() ? first : again;
        count_to(counters, lists.candidates, lists.solved);
        out.foresaw.push_back(counters.foresees());
        out.told.push_back({counters.length(&wt_counters::candidates, capacity, Stage::transfer),
                            counters.length(&wt_counters::solved, capacity, Stage::transfer)});
        if (counters.foresees()) return;
        CHECK(out.told.back().candidates == lists.candidates);
        CHECK(out.told.back().solved == lists.solved);
      },
      [&](const wt_counters& now) { CHECK(now.solved == (out.told.size() == 1 ? first : again).solved); });
  CHECK(!counters.foresees());
  CHECK(end.solved == (out.told.size() == 1 ? first : again).solved);
  return out;
}

using Runs = std::vector<bool>;  // for each run: are lengths foreseen?

Runs runs(Counters& counters, bool alike, Lists lists, size_t capacity = list_room) {
  return run_frame(counters, alike, lists, lists, capacity).foresaw;
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
  CHECK(runs(counters, true, {10'000, 300}) == Runs{false});
  CHECK(counters.last().candidates == 10'000);
  const CountedFrames next = run_frame(counters, true, {10'000, 300}, {});
  CHECK(next.foresaw == Runs{true});
  CHECK(next.told[0].candidates >= 12'500);
  CHECK(run_frame(counters, true, {10'000, 300}, {}, 11'000).told[0].candidates == 11'000);  // the room of the list
}

TEST_CASE("a frame that is not like the one before is read, and nothing is learnt from it") {
  Counters counters(context());
  REQUIRE(runs(counters, true, {10'000, 300}) == Runs{false});
  CHECK(runs(counters, false, {50'000, 300}) == Runs{false});
  CHECK(counters.last().candidates == 10'000);
  CHECK(runs(counters, true, {10'000, 300}) == Runs{true});
}

TEST_CASE("a frame with more than was foreseen runs once more and is read, and the next one foresees it") {
  Counters counters(context());
  REQUIRE(runs(counters, true, {10'000, 300}) == Runs{false});
  CHECK(runs(counters, true, {12'000, 1'200}) == Runs{true});
  // One list is enough. A surface that hides paths during the first run hides them from the start in the second: counts
  // may be lower then, and yet the next frame needs the room of the first.
  CHECK(run_frame(counters, true, {12'000, 9'000}, {12'000, 2'000}).foresaw == Runs{true, false});
  CHECK(counters.last().solved == 2'000);
  CHECK(runs(counters, true, {12'000, 9'000}) == Runs{true});
  // A list that is too small for its content is made again, too.
  CHECK(runs(counters, true, {12'000, 9'000}, 8'500) == Runs{true, false});
}

TEST_CASE("a full set of sequences is made again where lengths are foreseen") {
  Counters counters(context());
  REQUIRE(runs(counters, true, {100, 100}) == Runs{false});
  unsigned tries = 0;
  counters.settled(
      true, Stage::transfer, [&] { return counters.zero(); },
      [&] {
        CHECK(counters.foresees() == (tries == 0));
        if (tries++ == 0) counters.restart(&wt_counters::trie_overflow, 1, Stage::transfer);
      },
      [](const wt_counters&) {});
  CHECK(tries == 2);
}

TEST_CASE("nothing is foreseen after a frame whose lists were made in parts") {
  Counters counters(context());
  REQUIRE(runs(counters, true, {100, 100}) == Runs{false});
  counters.settled(
      true, Stage::transfer, [&] { return counters.zero(); }, [&] { counters.in_parts(); }, [](const wt_counters&) {});
  CHECK(runs(counters, true, {100, 100}) == Runs{false});
  CHECK(runs(counters, true, {100, 100}) == Runs{true});
}

TEST_CASE("a frame that is given up foresees nothing for what comes after it; none runs within another") {
  Counters counters(context());
  REQUIRE(runs(counters, true, {100, 100}) == Runs{false});
  const auto zero = [&] { return counters.zero(); };
  const auto nothing = [](const wt_counters&) {};
  const auto give_up = [&] {
    CHECK(counters.foresees());
    throw std::runtime_error("given up");
  };
  CHECK_THROWS_AS(counters.settled(true, Stage::transfer, zero, give_up, nothing), std::runtime_error);
  CHECK(!counters.foresees());
  const auto again = [&] {
    counters.settled(
        true, Stage::transfer, zero, [] {}, nothing);
  };
  CHECK_THROWS_AS(counters.settled(true, Stage::transfer, zero, again, nothing), std::logic_error);
  CHECK(runs(counters, true, {100, 100}) == Runs{true});
}
