// SPDX-License-Identifier: Apache-2.0
// Tests predicates and judges of caches on rows of two numbers of rays, whose answers are known by hand.
// claim_trials_test.cpp tests the claims that consist of them.
#include "study/cache_claims.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include "study/short_answers.hpp"

using namespace wavetracer::study;
using namespace short_answers;

namespace {

// Makes a row of one world at one number of rays: seconds per frame and metres of the centroid.
CacheRow row(const std::string& setting, uint64_t rays, double seconds, double off_m = 0,
             const std::string& drive = "fixed") {
  CacheRow out{.drive = drive, .setting = setting, .rays = rays};
  out.warm.loop_s = seconds;
  out.warm_error.loop_s = 0.001;
  out.saved_percent = 100 * (1 - seconds);  // the first setting takes a second
  out.error.l2_m = off_m;
  out.l2_error_m = 0.001;
  return out;
}

const CacheRows two_counts = {row("none", 1000, 1), row("a", 1000, 0.9, 1), row("b", 1000, 0.8, 3),
                              row("none", 5000, 1), row("a", 5000, 0.5, 4), row("b", 5000, 1.1, 3)};
const CachePoint few{"fixed", 1000}, many{"fixed", 5000}, elsewhere{"moving", 1000};

Answer answer_at(const AtPoint& predicate, const CachePoint& at, const CacheRows& rows = two_counts) {
  return predicate.at(rows, at).answer;
}
std::string words_on(const Judge<CacheRow>& judge, const CacheRows& rows = two_counts) { return words_of(judge(rows)); }

}  // namespace

TEST_CASE("predicates at a point: time") {
  CHECK(answer_at(saves({"a", "b"}), few) == yes);
  CHECK(answer_at(saves({"b"}), many) == no);
  CHECK(answer_at(saves({"a"}), elsewhere) == absent);
  CHECK(answer_at(saves({"a"}), {"fixed", 1}, {row("none", 1, 1), row("a", 1, 0.996)}) == open);
  CHECK(answer_at(saves_not({"b"}), many) == yes);
  CHECK(answer_at(saves_not({"a"}), many) == no);
  CHECK(answer_at(saves_percent("a", 8.9), few) == yes);
  CHECK(answer_at(saves_percent("a", 5), few) == Answer::beyond);
  CHECK(answer_at(saves_percent("a", 10), few) == open);
  CHECK(answer_at(saves_percent("a", 12), few) == no);
  CHECK(answer_at(all_save({"a", "b"}), few) == yes);
  CHECK(answer_at(all_save({"a", "b"}), many) == no);
  CHECK(answer_at(all_take_the_time_of_none({"a"}, 20), few) == yes);
  CHECK(answer_at(all_take_the_time_of_none({"a", "b"}, 15), few) == no);
  CHECK(answer_at(all_take_the_time_of_none({"a"}, 10), few) == open);
  CHECK(answer_at(fastest_is("b", {"a", "b"}), few) == yes);
  CHECK(answer_at(fastest_is("b", {"a", "b"}), many) == no);
  CHECK(answer_at(slowest_is("a", {"a", "b"}), few) == yes);
  CHECK(answer_at(fastest_is("c", {"a", "b"}), few) == absent);
}

TEST_CASE("predicates at a point: comparisons of values") {
  CHECK(answer_at(less(warm_s, "b", "a"), few) == yes);
  CHECK(answer_at(less(warm_s, "b", "a", 1.2), few) == no);
  CHECK(answer_at(less(warm_s, "b", "a", 1.125), few) == open);
  CHECK(answer_at(less(warm_s, "b", "c"), few) == absent);
  CHECK(answer_at(less(l2_m, "none", "none"), few) == no);
  CHECK(answer_at(at_most(l2_m, "a", 2, unit_form("m")), few) == yes);
  CHECK(answer_at(at_most(l2_m, "a", 2, unit_form("m")), many) == no);
  CHECK(answer_at(at_most(l2_m, "a", 4, unit_form("m")), many) == open);
  CHECK(answer_at(at_most(l2_m, "c", 1, unit_form("m")), few) == absent);
  CHECK(answer_at(largest_are(l2_m, {"b"}, {"a", "b"}), few) == yes);
  CHECK(answer_at(largest_are(l2_m, {"b"}, {"a", "b"}), many) == no);
  CHECK(less(warm_s, "b", "a").at(two_counts, few).value == doctest::Approx(0.8 / 0.9));
}

TEST_CASE("judges: where, of settings, the first number of rays") {
  CacheRows worlds = two_counts;
  worlds.push_back(row("none", 1000, 1, std::nan(""), "moving"));
  worlds.push_back(row("a", 1000, 0.9, std::nan(""), "moving"));
  CHECK(words_on(where(saves({"b"}))) ==
        "fixed transmitter: yes at 1,000 rays, no at 5,000 rays (20% less time to 10% more time)");
  CHECK(words_on(where(at_most(l2_m, "a", 7, unit_form("m"))), worlds) ==
        "fixed transmitter: yes at 1,000 and 5,000 rays (1.00 to 4.00 m); moving transmitters: not measured");
  const auto slow = [](const CacheRow& one) { return Answered{above(warm_s(one), 0.85), one.warm.loop_s}; };
  CHECK(words_on(of_each({"a", "b"}, slow, unit_form("s"))) == "\"a\": yes (0.900 s); \"b\": no (0.800 s)");
  CHECK(words_on(of_each({"c"}, slow, unit_form("s"))) == "not measured");
  CHECK(words_on(is_less(warm_s, "b", "a")) == "yes (b over a: 0.89)");
  CHECK(words_on(is_less(warm_s, "a", "b")) == "no (a over b: 1.12)");
}

TEST_CASE("judges of averages, and of changes with the number of rays") {
  CHECK(words_on(on_average(l2_m, "b", "a", 1, 1.3)) == "fixed transmitter: yes (b over a: 1.20)");
  CHECK(words_on(on_average(l2_m, "b", "a", 2, 3)) == "fixed transmitter: no (b over a: 1.20)");
  CHECK(words_on(on_average(l2_m, "b", "c", 2, 3)) == "fixed transmitter: not measured");
  CHECK(words_on(on_average(l2_m, "b", "none", 2, 3)) == "fixed transmitter: no (the other is 0)");
  CHECK(words_on(on_average(l2_m, "none", "none", 2, 3)) == "fixed transmitter: undecided (both are 0)");
  CHECK(words_on(mean_between(l2_m, "a", 2, 3, "m")) == "fixed transmitter: yes (2.50 m)");
  CHECK(words_on(mean_between(l2_m, "a", 3, 4, "m")) == "fixed transmitter: no (2.50 m)");
  CHECK(words_on(saving_grows("a")) ==
        "fixed transmitter: yes (10% less time at 1,000 rays and 50% less time at 5,000)");
  CHECK(words_on(saving_grows("b")) ==
        "fixed transmitter: no (20% less time at 1,000 rays and 10% more time at 5,000)");
  CHECK(words_on(saves_most_at({"a"}, 5000)) == "fixed transmitter: yes (500 ms are saved there)");
  CHECK(words_on(saves_most_at({"b"}, 5000)) == "fixed transmitter: no (-100 ms are saved there)");
  CHECK(words_on(saves_most_at({"b"}, 7000)) == "fixed transmitter: not measured");
}

TEST_CASE("a setting that gains from fewer rays on than another one") {
  const CacheRows rows = {row("none", 1000, 1), row("a", 1000, 0.9), row("b", 1000, 1.1), row("c", 1000, 0.999),
                          row("none", 5000, 1), row("a", 5000, 0.9), row("b", 5000, 0.9), row("c", 5000, 1.1)};
  CHECK(words_on(gains_earlier("a", "b"), rows) ==
        "fixed transmitter: yes (from 1,000 rays on, the other from 5,000 rays on)");
  CHECK(words_on(gains_earlier("b", "a"), rows) ==
        "fixed transmitter: no (from 5,000 rays on, the other from 1,000 rays on)");
  CHECK(words_on(gains_earlier("a", "c"), rows) ==
        "fixed transmitter: undecided (from 1,000 rays on, the other nowhere)");
  CHECK(words_on(gains_earlier("a", "absent"), rows) == "fixed transmitter: not measured");
}
