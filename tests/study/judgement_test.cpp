// SPDX-License-Identifier: Apache-2.0
// Tests the model of verdicts on numbers that are known by hand: comparisons with noise, shares of cases, ranges,
// words.
#include "study/judgement.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include "study/cache_claims.hpp"
#include "study/cache_verdicts.hpp"
#include "study/short_answers.hpp"
#include "study/table_regions.hpp"

using namespace wavetracer::study;
using namespace cache_verdicts;
using namespace short_answers;

namespace {

Cases cases_of(const std::vector<Answer>& answers) {
  Cases out;
  for (const Answer answer : answers) out.all.push_back({"", out.all.size() + 1, answer});
  return out;
}
ClaimOutcome outcome_of_answers(const std::vector<Answer>& answers) { return outcome_of(cases_of(answers)); }

}  // namespace

TEST_CASE("comparisons decide beyond twice the standard error, and beyond a hundredth of the value") {
  CHECK(above({1.21, 0.1}, 1) == yes);
  CHECK(above({1.19, 0.1}, 1) == open);
  CHECK(above({0.81, 0.1}, 1) == open);
  CHECK(above({0.79, 0.1}, 1) == no);
  CHECK(above({1.009, 0}, 1) == open);  // a factor of 1.01 and less decides nothing
  CHECK(above({1.02, 0}, 1) == yes);
  CHECK(above({1.04, std::nan("")}, 1) == open);  // its noise is not known
  CHECK(above({1.06, std::nan("")}, 1) == yes);
  CHECK(above({}, 1) == absent);
  CHECK(below({0.98, 0}, 1) == yes);
  CHECK(below({1.02, 0}, 1) == no);
  CHECK(between({0.25, 0.01}, 0.2, 0.3) == yes);
  CHECK(between({0.29, 0.01}, 0.2, 0.3) == open);
  CHECK(between({0.4, 0.01}, 0.2, 0.3) == no);
  CHECK(between({0, 0}, 0, 1) == yes);
  CHECK(reaches({2.6, 0}, 2.5) == yes);
  CHECK(reaches({2.8, 0}, 2.5) == more);
  CHECK(reaches({2.51, 0}, 2.5) == open);
  CHECK(reaches({2.4, 0}, 2.5) == no);
}

TEST_CASE("two measured numbers: their noises add up, exact zeros are equal") {
  CHECK(less({1, 0.03}, {1.1, 0.03}) == yes);  // 2 * 0.042 < 0.1
  CHECK(less({1, 0.04}, {1.1, 0.04}) == open);
  CHECK(less({1.1, 0.03}, {1, 0.03}) == no);
  CHECK(less({1, 0}, {1.001, 0}) == open);
  CHECK(less({0, 0}, {0, 0}) == no);
  CHECK(less({}, {1, 0}) == absent);
  const Measured half = quotient({1, 0.03}, {2, 0.08});
  CHECK(half.value == 0.5);
  CHECK(half.error == doctest::Approx(0.5 * 0.05));
  CHECK(all_of({yes, more}) == yes);
  CHECK(all_of({yes, open}) == open);
  CHECK(all_of({no, open}) == no);
  CHECK(all_of({}) == absent);
  CHECK(opposite(yes) == no);
  CHECK(opposite(no) == yes);
  CHECK(opposite(open) == open);
}

TEST_CASE("noise of repeats: of a mean, of a median, and without what all subjects have in common") {
  CHECK(error_of_mean({1, 3}) == doctest::Approx(1));
  CHECK(error_of_median({1, 3}) == doctest::Approx(std::sqrt(std::acos(-1.0) / 2)));
  CHECK(std::isnan(error_of_mean({1})));
  // Rounds take 1, 2 and 4 times as long for both: each takes the same share of every round.
  const std::vector<double> common = relative_errors({{1, 2, 4}, {2, 4, 8}});
  CHECK(common[0] == doctest::Approx(0));
  CHECK(common[1] == doctest::Approx(0));
  // Shares 1/2 and 3/4: a mean of 5/8, deviations of 1/8.
  CHECK(relative_errors({{1, 3}, {1, 1}})[0] == doctest::Approx(0.125 / 0.625));
  CHECK(std::isnan(relative_errors({{1}, {1}})[0]));
}

TEST_CASE("coefficients of few pairs decide little") {
  CHECK(correlates(0.99, 3) == open);
  CHECK(correlates(0.9, 4) == open);
  CHECK(correlates(0.95, 8) == yes);
  CHECK(correlates(-0.5, 8) == no);
  CHECK(correlates(std::nan(""), 8) == absent);
}

TEST_CASE("a verdict follows from the shares of the cases") {
  CHECK(outcome_of_answers({}) == ClaimOutcome::not_measured);
  CHECK(outcome_of_answers({absent, absent}) == ClaimOutcome::not_measured);
  CHECK(outcome_of_answers({yes, yes, absent}) == ClaimOutcome::reproduced);
  CHECK(outcome_of_answers({yes, yes, open}) == ClaimOutcome::reproduced);
  CHECK(outcome_of_answers({yes, more}) == ClaimOutcome::reproduced);
  CHECK(outcome_of_answers({more, more}) == ClaimOutcome::exceeded);
  CHECK(outcome_of_answers({no, no, open}) == ClaimOutcome::refuted);
  CHECK(outcome_of_answers({no, yes, yes}) == ClaimOutcome::in_part);
  CHECK(outcome_of_answers({open, open, yes}) == ClaimOutcome::undecided);
  CHECK(outcome_of_answers({open, no}) == ClaimOutcome::undecided);
  CHECK(outcome_of_answers({open}) == ClaimOutcome::undecided);
  CHECK(outcome_of(Cases{.why = "no timer"}) == ClaimOutcome::not_judged);
  CHECK(outcomes().size() == 7);
}

TEST_CASE("a range is covered if a measured number of rays is in it, and not far from its end") {
  CHECK_FALSE(up_to(50000000).is_covered({2000}));
  CHECK_FALSE(up_to(50000000).is_covered({1000, 12000000}));
  CHECK(up_to(50000000).is_covered({1000, 12500000}));
  CHECK(up_to(37000).is_covered({1000, 10000, 61000}));
  CHECK_FALSE(at_rays(61000).is_covered({1000, 10000}));
  CHECK(at_rays(61000).is_covered({1000, 61000}));
  CHECK(beyond(50000).is_covered({64000}));
  CHECK_FALSE(beyond(50000).is_covered({50000}));
  CHECK_FALSE(Range{70000, 90000}.is_covered({49000, 200000}));
  CHECK_FALSE(Range{}.is_covered({}));
}

TEST_CASE("numbers of rays outside of a claim's range say nothing about it") {
  const char *at = "by precision, the mixed hash takes noticeably more time than no cache at 61,000 rays",
             *to = "by precision, the mixed hash is faster than no cache, up to 37,000 rays";
  const auto judge = [](const char* words, const std::vector<uint64_t>& rays) {
    const CacheCost cost = [](const std::string& setting, uint64_t count) {
      return std::pair{setting != "precision 0.0125 mixed" ? 1.0 : count <= 37000 ? 0.8 : 1.3, 0.0};
    };
    return judgement_of_claim("figure-6.16", words, rays, cost);
  };
  CHECK(judge(at, {2000}).outcome == ClaimOutcome::not_measured);
  CHECK(judge(at, {2000}) == "measured at 2,000 rays");
  CHECK(judge(at, {1000, 37000}) == "measured from 1,000 to 37,000 rays");
  CHECK(judge(at, {1000, 61000}).outcome == ClaimOutcome::reproduced);
  CHECK(judge(to, {1000, 61000}).outcome == ClaimOutcome::not_measured);
  CHECK(judge(to, {1000, 37000, 61000}).outcome == ClaimOutcome::reproduced);
}

TEST_CASE("words: the places of each answer, by group, and the measured numbers") {
  Cases cases{.all = {{"a", 1000, yes, 0.8}, {"a", 5000, no, 1.1}, {"a", 9000, open, 1}, {"b", 1000, yes, 0.5}},
              .form = time_form()};
  CHECK(words_of(cases) ==
        "a: yes at 1,000 rays, no at 5,000 rays, undecided at 9,000 rays (20% less time to 10% more time); "
        "b: yes at 1,000 rays (50% less time)");
  CHECK(words_of(cases_of({yes, yes, yes, yes})) == "yes at all 4 numbers of rays");
  CHECK(words_of(cases_of({yes, yes, yes, yes, no})) == "yes at 4 of 5 numbers of rays, no at 5 rays");
  CHECK(words_of(cases_of({absent})) == "not measured");
  CHECK(words_of({}) == "not measured");
  cases = {.all = {{"", 0, yes, 3}}, .form = factor_form()};
  CHECK(words_of(cases) == "yes (a factor of 3.00)");
  cases.all[0].note = "both are 0";
  CHECK(words_of(cases) == "yes (a factor of 3.00; elsewhere both are 0)");
  cases.all[0].value = std::nan("");
  CHECK(words_of(cases) == "yes (both are 0)");
  CHECK(words_of({.all = {{"", 0, yes, 0.63}}, .form = ratio_form("a", "b")}) == "yes (a over b: 0.63)");
  cases = {.all = {{"", 1, yes, 0.25}, {"", 2, yes, 0.3}}, .form = correlation_form(), .at = "depth"};
  CHECK(words_of(cases) == "yes at depths 1 and 2 (0.25 to 0.30)");
  CHECK(words_of(Cases{.why = "no timer"}) == "no timer");
}
