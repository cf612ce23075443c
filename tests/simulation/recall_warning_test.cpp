// SPDX-License-Identifier: Apache-2.0
// Tests when a refined launch that ended early gives a warning, what the warning advises, and which launches do not
// show what they missed.
#include "simulation/recall_warning.hpp"

#include <doctest/doctest.h>

using namespace wavetracer;

namespace {

// well_known: number of paths that all quarters of the launch found, so that probably none is missed; rare: that only
// one found.
MissedCounts counts(uint64_t well_known, uint64_t rare) {
  MissedCounts out;
  out.frames = 1;
  out.paths = {rare, 0, 0, well_known};
  return out;
}

DiscoveryCounts counts_of(double share_once, LaunchEnd end) {
  DiscoveryCounts out;
  out.share_once = share_once;
  out.end = end;
  return out;
}

bool warns(LaunchEnd end, bool cold, const MissedCounts& missed, double recall = 0.99) {
  TraceConfig trace;
  trace.recall = recall;
  return recall_warning(counts_of(0.2, end), trace, cold, missed).has_value();
}

}  // namespace

TEST_CASE("a launch that found what was asked for is no news; one that was capped always is") {
  for (const bool cold : {false, true}) {
    CHECK_FALSE(warns(LaunchEnd::recall, cold, counts(10, 90)));
    CHECK(warns(LaunchEnd::max_rays, cold, counts(100, 0)));
  }
}

TEST_CASE("a launch that had nothing left to refine is news where a cold frame's paths say that some are missed") {
  for (const LaunchEnd end : {LaunchEnd::finest, LaunchEnd::nothing_rare}) {
    CHECK(warns(end, true, counts(10, 90)));
    CHECK_FALSE(warns(end, true, counts(100000, 0)));
    CHECK_FALSE(warns(end, false, counts(10, 90)));  // earlier frames found paths that this frame's rays need not find
    CHECK(warns(end, true, MissedCounts{}));         // there are no counts
    CHECK(warns(end, true, counts(100000, 0), 1));   // recall of all paths: it is never known
  }
}

TEST_CASE("warnings say what ended the launch, how much is met once, and what to do") {
  TraceConfig trace;
  trace.recall = 0.999;
  trace.max_rays = 5000;
  const auto text = [&](LaunchEnd end, double once) {
    return recall_warning(counts_of(once, end), trace, true, {}).value_or("");
  };
  CHECK(text(LaunchEnd::max_rays, 0.25) ==
        "trace.max_rays = 5000 ended the launch of rays = \"auto\" before it reached trace.recall = 0.999: "
        "25% of the sequences found were met by only one ray");
  CHECK(text(LaunchEnd::finest, 0.001).find("less than 1% of the sequences") != std::string::npos);
  CHECK(text(LaunchEnd::nothing_rare, 0.1).find("give trace.rays a number to find more") != std::string::npos);
}

TEST_CASE("rays of which few met anything tell nothing; a thousand, or a fiftieth, are enough") {
  DiscoveryCounts found;
  found.rays = 200000;
  for (const auto& [hits, warned] : {std::pair{uint64_t{0}, true}, {40, true}, {999, true}, {1000, false}}) {
    CAPTURE(hits);
    found.hits = hits;
    CHECK(few_met_warning(found, true).has_value() == warned);
    CHECK_FALSE(few_met_warning(found, false).has_value());  // there is nothing to be met
  }
  found.rays = 1000;
  found.hits = 20;
  CHECK_FALSE(few_met_warning(found, true).has_value());
  found.hits = 19;
  CHECK(few_met_warning(found, true).value_or("").find("it is not known how many paths they missed") !=
        std::string::npos);
  CHECK_FALSE(few_met_warning({}, true).has_value());  // no rays were launched
}

TEST_CASE("rays of which houses may lie between tell nothing; the warning has a number that is enough") {
  DiscoveryCounts found;
  found.rays = 100000;
  found.spread_m2 = 1e5 * 29.9 * 29.9;
  CHECK_FALSE(far_apart_warning(found, 1e5).has_value());
  CHECK(far_apart_warning(found, 99000).has_value());
  found.spread_m2 = 1e5 * 230 * 230;
  const std::string text = far_apart_warning(found, 1e5).value_or("");
  CHECK(text.starts_with("rays are 200 m and more apart where a receiver is"));
  CHECK(text.find("above 6e+06;") != std::string::npos);  // 1e5 (230 / 30)^2
  CHECK_FALSE(far_apart_warning(found, 6e6).has_value());
  found.rays = 0;
  CHECK_FALSE(far_apart_warning(found, 1e5).has_value());
}

TEST_CASE("a frame without rays tells what the one before it told; warm frames add rays, and a cold one forgets") {
  DiscoveryCounts sparse, none;
  sparse.rays = sparse.hits = 10000;
  sparse.rays_each = 10000;
  sparse.spread_m2 = 25000.0 * 30 * 30;
  RayWitness witness;
  CHECK(witness.tells());
  CHECK(witness.hear(sparse, true, true).has_value());
  CHECK_FALSE(witness.tells());
  CHECK_FALSE(witness.hear(none, false, true).has_value());
  CHECK_FALSE(witness.tells());
  CHECK(witness.hear(sparse, false, true).has_value());
  CHECK_FALSE(witness.hear(sparse, false, true).has_value());  // the third launch: 30,000 rays in all
  CHECK(witness.tells());
  CHECK(witness.hear(sparse, true, true).has_value());
  CHECK_FALSE(witness.hear(sparse, true, false).has_value());  // there is nothing to be met
  DiscoveryCounts lost = sparse;
  lost.hits = 10;
  lost.spread_m2 = 0;
  CHECK(witness.hear(lost, true, true).value_or("").starts_with("less than 2% of the rays"));
  CHECK_FALSE(witness.tells());
  CHECK_FALSE(witness.hear(none, true, true).has_value());
  CHECK(witness.tells());  // a cold frame without rays has nothing to miss
}
