// SPDX-License-Identifier: Apache-2.0
// Tests every claim of every experiment with rows that make it true, false and undecided. A claim without such a trial
// is a failure, as is a trial without its claim.
#include "study/claim_trials.hpp"
#include <doctest/doctest.h>
#include <set>

using namespace claim_trials;

namespace {

template <class Figure>
Range range_of(const Figure& figure) {
  if constexpr (requires { figure.range; }) return figure.range;
  return {};
}

// The words are those of claims without their fields.
template <class Row, class Figure>
void check_claims(const std::vector<Trial<Row>>& trials, std::set<std::string>& tried) {
  for (const Experiment& experiment : experiments()) {
    const Figure* figure = experiment.as<Figure>();
    if (!figure) continue;
    std::set<std::string> words;
    for (const Claim<Row>& claim : figure->claims) {
      CAPTURE(experiment.name);
      CAPTURE(claim.words);
      CHECK(words.insert(claim.words).second);  // it occurs once
      const auto found = std::ranges::find_if(
          trials, [&](const Trial<Row>& one) { return one.figure == experiment.name && one.words == claim.words; });
      if (found == trials.end()) {
        // A claim that no measurement can decide has no predicate.
        const Judgement judgement = judgement_of(claim.judge(std::vector<Row>(1)));
        CHECK(judgement.outcome == ClaimOutcome::not_judged);
        continue;
      }
      tried.insert(experiment.name + claim.words);
      const auto judged_as = [&](const auto& rows) { return judgement_of(claim, rows(), range_of(*figure)); };
      const Judgement yes = judged_as(found->yes), no = judged_as(found->no), third = judged_as(found->third);
      CAPTURE(yes);
      CAPTURE(no);
      CAPTURE(third);
      CHECK((yes.outcome == ClaimOutcome::reproduced || yes.outcome == ClaimOutcome::exceeded));
      CHECK(no.outcome == ClaimOutcome::refuted);
      CHECK(third.outcome == (found->is == Third::undecided ? ClaimOutcome::undecided : ClaimOutcome::not_measured));
    }
  }
  for (const Trial<Row>& one : trials) {
    CAPTURE(one.words);
    CHECK(tried.contains(one.figure + one.words));
  }
}

}  // namespace

TEST_CASE("every claim about caches: rows that make it true, false and undecided") {
  std::vector<Trial<CacheRow>> trials = standing_trials();
  for (const auto& more : {traffic_trials(), innerframe_trials()})
    trials.insert(trials.end(), more.begin(), more.end());
  std::set<std::string> tried;
  check_claims<CacheRow, CacheFigure>(trials, tried);
  CHECK(tried.size() == trials.size());
}

TEST_CASE("every claim about orders: rows that make it true, false and undecided") {
  std::set<std::string> tried;
  check_claims<OrderRow, OrderFigure>(order_trials(), tried);
}

TEST_CASE("every claim about frames: rows that make it true, false and undecided") {
  std::set<std::string> tried;
  check_claims<FramePair, FrameFigure>(frame_trials(), tried);
}
