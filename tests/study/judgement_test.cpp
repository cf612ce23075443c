// SPDX-License-Identifier: Apache-2.0
// Tests outcomes of claims on cases that are known by hand: a claim that holds, one that does not, and those in
// between.
#include "study/judgement.hpp"
#include <doctest/doctest.h>
#include "study/cache_verdicts.hpp"
#include "study/coherence_frames.hpp"
#include "study/innerframe_claims.hpp"
#include "study/made_order_rows.hpp"
#include "study/order_claims.hpp"

using namespace wavetracer::study;
using namespace cache_verdicts;

namespace {

ClaimOutcome outcome_of(const std::vector<std::pair<bool, bool>>& cases) {
  Tally tally;
  for (const auto& [holds, beyond] : cases) tally.add(holds, beyond);
  return tally.outcome();
}

}  // namespace

TEST_CASE("a tally: all, none, some, and all beyond what was claimed") {
  CHECK(outcome_of({}) == ClaimOutcome::not_judged);
  CHECK(outcome_of({{true, false}, {true, false}}) == ClaimOutcome::reproduced);
  CHECK(outcome_of({{true, true}, {true, false}}) == ClaimOutcome::reproduced);
  CHECK(outcome_of({{true, true}, {true, true}}) == ClaimOutcome::exceeded);
  CHECK(outcome_of({{false, false}, {false, true}}) == ClaimOutcome::refuted);
  CHECK(outcome_of({{true, true}, {false, false}}) == ClaimOutcome::in_part);
}

TEST_CASE("outcomes of worlds join to one: what was not judged speaks for nothing") {
  const auto joined = [](std::initializer_list<ClaimOutcome> outcomes) {
    Tally tally;
    for (const ClaimOutcome outcome : outcomes) tally.add(outcome);
    return tally.outcome();
  };
  CHECK(joined({ClaimOutcome::reproduced, ClaimOutcome::not_judged}) == ClaimOutcome::reproduced);
  CHECK(joined({ClaimOutcome::exceeded, ClaimOutcome::reproduced}) == ClaimOutcome::reproduced);
  CHECK(joined({ClaimOutcome::exceeded, ClaimOutcome::exceeded}) == ClaimOutcome::exceeded);
  CHECK(joined({ClaimOutcome::refuted, ClaimOutcome::exceeded}) == ClaimOutcome::in_part);
  CHECK(joined({ClaimOutcome::in_part, ClaimOutcome::reproduced}) == ClaimOutcome::in_part);
  CHECK(joined({ClaimOutcome::refuted, ClaimOutcome::not_judged}) == ClaimOutcome::refuted);
  CHECK(joined({ClaimOutcome::not_judged}) == ClaimOutcome::not_judged);
}

TEST_CASE("caches: a share of time that is saved, less, more, and in one world of two alone") {
  const std::string words = "15% less time if purged by position, for many rays";
  const auto outcome = [&](double seconds) {
    return judgement_of("figure-6.11", words, {1000, 5000}, only("position mixed", seconds)).outcome;
  };
  CHECK(outcome(0.86) == ClaimOutcome::refuted);
  CHECK(outcome(0.845) == ClaimOutcome::reproduced);
  CHECK(outcome(0.8) == ClaimOutcome::exceeded);
  const CacheCost late = [](const std::string& setting, uint64_t rays) {
    return std::pair{setting == "position mixed" && rays == 5000 ? 0.5 : 1.0, 0.0};
  };
  CHECK(judgement_of("figure-6.11", words, {1000, 5000}, late).outcome == ClaimOutcome::in_part);
}

TEST_CASE("caches: every kind of judge says the outcome that its words say") {
  const auto outcome = [](const char* figure, const char* words, const std::vector<uint64_t>& rays,
                          const CacheCost& cost) { return judgement_of(figure, words, rays, cost).outcome; };
  const char* gain = "a gain from 2,560,000 to 10,240,000 rays";  // everywhere()
  CHECK(outcome("figure-6.5", gain, {2560000}, only("chained mixed", 0.5)) == ClaimOutcome::reproduced);
  CHECK(outcome("figure-6.5", gain, {2560000}, same) == ClaimOutcome::refuted);
  CHECK(outcome("figure-6.5", gain, {1000}, same) == ClaimOutcome::not_judged);
  const char* twice = "by position, on average twice as far off with Morton codes as with the uniform hash";
  const auto off = [](double morton, double uniform) {
    return errors("position Morton", morton, "position uniform", uniform);
  };
  CHECK(outcome("figure-6.15", twice, {1000}, off(2, 1)) == ClaimOutcome::reproduced);
  CHECK(outcome("figure-6.15", twice, {1000}, off(1, 1)) == ClaimOutcome::refuted);
  CHECK(outcome("figure-6.15", twice, {1000}, off(0, 0)) == ClaimOutcome::not_judged);
  const char* five = "around 5 m by precision with the uniform hash";
  const auto metres = [](double m) { return only("precision 0.0125 uniform", 1, m); };
  CHECK(outcome("figure-6.17", five, {1000}, metres(5)) == ClaimOutcome::reproduced);
  CHECK(outcome("figure-6.17", five, {1000}, metres(50)) == ClaimOutcome::refuted);
  CHECK(outcome("figure-6.3", "tracing takes longer for buckets than for other nodes", {1000}, same) ==
        ClaimOutcome::not_judged);
}

TEST_CASE("orders: a gain that is reached, exceeded, missed, and reached with the sort not paid alone") {
  const auto outcome = [](double ordered_s, double sort_s) {
    const auto rows = made_rows(find_experiment("figure-6.1"), {49000}, [&](const Series& series, uint64_t) {
      return series.method == "none" ? std::pair{1.0, 0.0} : std::pair{ordered_s, sort_s};
    });
    return gains(ordered("hilbert3d-histogram"), 49000, 2.5)(rows).outcome;
  };
  CHECK(outcome(0.5, 0) == ClaimOutcome::refuted);
  CHECK(outcome(0.39, 0) == ClaimOutcome::reproduced);
  CHECK(outcome(0.3, 0) == ClaimOutcome::exceeded);
  CHECK(outcome(0.3, 0.2) == ClaimOutcome::in_part);
}

TEST_CASE("coherence between frames: depths and pairings are cases") {
  const auto outcome = [](double first, double second) {
    std::vector<FramePair> rows(2);
    for (size_t i = 0; i < 2; ++i) {
      rows[i].against = "previous";
      rows[i].frame = 1;
      rows[i].depth = static_cast<uint32_t>(i + 1);
      rows[i].found.points.total = rows[i].by_place = i == 0 ? first : second;
    }
    return correlation_falls_below(0.1)(rows).outcome;
  };
  CHECK(outcome(0.05, 0.02) == ClaimOutcome::reproduced);
  CHECK(outcome(0.05, 0.3) == ClaimOutcome::in_part);
  CHECK(outcome(0.2, 0.3) == ClaimOutcome::refuted);
}
