// SPDX-License-Identifier: Apache-2.0
// Tests predicates on rows of caches, each with rows that make it true and rows that make it false; then the claims of
// figures 6.2 to 6.17 that consist of them.
#include "study/cache_claims.hpp"
#include <doctest/doctest.h>
#include <array>
#include <cmath>
#include <stdexcept>
#include "study/cache_verdicts.hpp"
#include "study/experiment.hpp"

using namespace wavetracer::study;
using namespace cache_verdicts;

namespace {

// Makes a row of one world at one number of rays: seconds per frame and metres of the centroid.
CacheRow row(const std::string& setting, uint64_t rays, double seconds, double off_m = 0,
             const std::string& drive = "fixed") {
  CacheRow out{.drive = drive, .setting = setting, .rays = rays};
  out.warm.loop_s = seconds;
  out.saved_percent = 100 * (1 - seconds);  // the first setting takes a second
  out.error.l2_m = off_m;
  return out;
}

const CacheRows two_counts = {row("none", 1000, 1), row("a", 1000, 0.9, 1), row("b", 1000, 0.8, 3),
                              row("none", 5000, 1), row("a", 5000, 0.5, 4), row("b", 5000, 1.1, 3)};

}  // namespace

TEST_CASE("predicates at a point") {
  const CachePoint few{"fixed", 1000}, many{"fixed", 5000}, elsewhere{"moving", 1000};
  CHECK(saves({"a", "b"})(two_counts, few));
  CHECK(saves({"b"})(two_counts, few));
  CHECK_FALSE(saves({"b"})(two_counts, many));
  CHECK_FALSE(saves({"a"})(two_counts, elsewhere));                                  // not measured
  CHECK_FALSE(saves({"a"})({row("none", 1, 1), row("a", 1, 0.996)}, {"fixed", 1}));  // within half a percent
  CHECK(saves_not({"b"})(two_counts, many));
  CHECK_FALSE(saves_not({"a"})(two_counts, many));
  CHECK(saves_percent("a", 9.9)(two_counts, few));
  CHECK_FALSE(saves_percent("a", 11)(two_counts, few));
  CHECK(fastest_is("b", {"a", "b"})(two_counts, few));
  CHECK_FALSE(fastest_is("b", {"a", "b"})(two_counts, many));
  CHECK(less(warm_s, "b", "a")(two_counts, few));
  CHECK_FALSE(less(warm_s, "b", "a", 1.2)(two_counts, few));
  CHECK_FALSE(less(warm_s, "b", "c")(two_counts, few));
  CHECK(at_most(l2_m, "a", 1)(two_counts, few));
  CHECK_FALSE(at_most(l2_m, "a", 1)(two_counts, many));
  CHECK_FALSE(at_most(l2_m, "c", 1)(two_counts, few));
}

TEST_CASE("judges: everywhere, where, of settings") {
  CHECK(everywhere(above(1000), saves({"a"}))(two_counts) == "confirmed");
  CHECK(everywhere(above(1000), saves({"b"}))(two_counts) == "not confirmed");
  CHECK(everywhere(above(5000), saves({"a"}))(two_counts) == "not measured");
  CHECK(everywhere(between(1000, 4999), saves({"b"}))(two_counts) == "confirmed");
  CHECK(everywhere(outside(1000, 4999), saves({"b"}))(two_counts) == "not confirmed");
  CacheRows worlds = two_counts;
  worlds.push_back(row("none", 1000, 1, std::nan(""), "moving"));
  worlds.push_back(row("a", 1000, 0.9, std::nan(""), "moving"));
  CHECK(where(saves({"b"}))(worlds) ==
        "fixed transmitter: at 1,000 rays; moving transmitters: at none of the numbers of rays");
  CHECK(where(saves({"a"}), l2_m)(worlds) ==
        "fixed transmitter: at every number of rays; moving transmitters: no path has a vertex");
  const auto slow = [](const CacheRow& one) { return one.warm.loop_s > 0.85; };
  CHECK(of_each({"a", "b"}, slow)(two_counts) == "confirmed for \"a\", not for \"b\"");
  CHECK(of_each({"a"}, slow)(two_counts) == "confirmed for all");
  CHECK(of_each({"b"}, slow)(two_counts) == "not confirmed for any");
  CHECK(of_each({"c"}, slow)(two_counts) == "not measured");
  CHECK(is_less(warm_s, "b", "a")(two_counts) == "confirmed");
  CHECK(is_less(warm_s, "a", "b")(two_counts) == "not confirmed");
}

TEST_CASE("figures 6.2, 6.3, 6.6 and 6.7: writes, reads and tracing of a segment") {
  const std::string no_timer = "rays are traced in packets and groups, so that no ray has a time of its own",
                    none = "not confirmed for any";
  // 80 segments are written, 100 read; nanoseconds as given.
  const auto times = [](double write, double read, double gather, double trace) {
    return [=](CacheRow& one) {
      one.cold.store_s = 80e-9 * write;
      one.cold.gather_s = 80e-9 * gather;
      one.cold.trace_s = 80e-9 * trace;
      one.warm.lookup_s = 100e-9 * read;
      if (one.setting.find("chained") != std::string::npos) one.cold.store_s *= 2;
    };
  };
  CHECK(verdicts_of("figure-6.2", {50000}, same, times(30, 20, 1, 0)) ==
        Verdicts{"confirmed for all", "confirmed for all", none, none});
  CHECK(verdicts_of("figure-6.2", {50000}, same, times(5, 20, 5, 0)) ==
        Verdicts{"not confirmed for any", "not confirmed for any", none, none});
  CHECK(verdicts_of("figure-6.3", {50000}, same, times(10, 20, 1, 210)) ==
        Verdicts{"confirmed for all", "confirmed for all", "confirmed for all", no_timer});
  CHECK(verdicts_of("figure-6.3", {50000}, same, times(10, 20, 1, 15)) ==
        Verdicts{"not confirmed for any", "not confirmed for any", "not confirmed for any", no_timer});
  const std::string no_regions = "not measured";
  CHECK(verdicts_of("figure-6.6", {50000}, same, times(30, 20, 1, 0)) ==
        Verdicts{"confirmed for all", "not confirmed for any", "confirmed for all", no_regions, no_regions, "confirmed",
                 "not confirmed"});  // reads take equally long in both
  CHECK(verdicts_of("figure-6.6", {50000}, same, times(60, 20, 7, 0))[1] == "confirmed for all");
  CHECK(verdicts_of("figure-6.6", {50000}, same, times(60, 20, 7, 0))[2] == "not confirmed for any");
  CHECK(verdicts_of("figure-6.7", {50000}, same, times(300, 20, 1, 210)) ==
        Verdicts{"confirmed for all", "confirmed for all", "not confirmed for any", no_regions, no_regions});
}

TEST_CASE("figure-6.9: a gain beyond 16,000 rays, of a mutex alone") {
  const auto with = [](const std::string& winner) {
    return [winner](const std::string& setting, uint64_t rays) {
      return std::pair{setting == winner && rays > 16000 ? 0.9 : 1.0, 0.0};
    };
  };
  const auto verdict = [&](const std::vector<uint64_t>& rays, const std::string& winner, const char* claim) {
    return verdict_of("figure-6.9", claim, rays, with(winner));
  };
  const char *ours = "a gain beyond 16,000 rays", *printed = "as printed: a gain beyond 16,000 rays";
  CHECK(verdict({1000, 32000}, "mutex Morton", ours) == "confirmed");
  CHECK(verdict({1000, 32000}, "concurrent", ours) == "not confirmed");
  CHECK(verdict({1000, 32000}, "printed mutex Morton", ours) == "not confirmed");
  CHECK(verdict({1000, 16000}, "mutex Morton", ours) == "not measured");
  CHECK(verdict({1000, 32000}, "printed mutex Morton", printed) == "confirmed");
  CHECK(verdict({1000, 32000}, "mutex Morton", printed) == "not confirmed");
}

TEST_CASE("figures 6.5 and 6.8: the same claims of the tables as printed") {
  const auto late = [](const std::string& setting) {
    return [setting](const std::string& one, uint64_t rays) {
      return std::pair{one == setting && rays >= 2560000 ? 0.9 : 1.0, 0.0};
    };
  };
  const std::vector<uint64_t> rays = {1000, 2560000}, beyond = {1000, 2560000, 20480000};
  const char *inside = "as printed: a gain from 2,560,000 to 10,240,000 rays",
             *outside = "as printed: no gain below 2,560,000 and beyond 10,240,000 rays";
  CHECK(verdict_of("figure-6.5", inside, rays, late("printed chained uniform")) == "confirmed");
  CHECK(verdict_of("figure-6.5", inside, rays, late("chained uniform")) == "not confirmed");
  CHECK(verdict_of("figure-6.5", outside, rays, late("printed chained uniform")) == "confirmed");
  CHECK(verdict_of("figure-6.5", outside, beyond, late("printed chained uniform")) == "not confirmed");
  const char* claim = "as printed: a gain beyond 50,000 rays";
  CHECK(verdict_of("figure-6.8", claim, rays, late("printed readers mixed")) == "confirmed");
  CHECK(verdict_of("figure-6.8", claim, rays, late("readers mixed")) == "not confirmed");
}

TEST_CASE("judges of averages") {
  CHECK(on_average(l2_m, "b", "a", 1, 1.3)(two_counts) == "fixed transmitter: confirmed, a factor of 1.20");
  CHECK(on_average(l2_m, "b", "a", 2, 3)(two_counts) == "fixed transmitter: not confirmed, a factor of 1.20");
  CHECK(on_average(l2_m, "b", "c", 2, 3)(two_counts) == "fixed transmitter: not measured");
  CHECK(on_average(l2_m, "b", "none", 2, 3)(two_counts) == "fixed transmitter: not confirmed, the other is 0");
  CHECK(on_average(l2_m, "none", "none", 2, 3)(two_counts) == "fixed transmitter: both are 0");
  CHECK(mean_between(l2_m, "a", 2, 3, "m")(two_counts) == "fixed transmitter: confirmed, 2.50 m");
  CHECK(mean_between(l2_m, "a", 3, 4, "m")(two_counts) == "fixed transmitter: not confirmed, 2.50 m");
  CHECK(mean_between(l2_m, "c", 3, 4, "m")(two_counts) == "fixed transmitter: not measured");
}

TEST_CASE("figure-6.11: claims on time by purging, of ours and as printed") {
  const auto check = [](const char* words, const std::string& setting, double claimed_s) {
    CAPTURE(words);
    CHECK(verdict_of("figure-6.11", words, {1000}, only(setting, claimed_s - 0.01)) == in_all(always));
    CHECK(verdict_of("figure-6.11", words, {1000}, only(setting, claimed_s + 0.01)) == in_all(never));
  };
  const std::string position = "position mixed", precision = "precision 0.0125 mixed";
  check("10% less time if purged by position, for small and medium numbers of rays", position, 0.9);
  check("15% less time if purged by position, for many rays", position, 0.85);
  check("17% less time if purged by precision, for many rays", precision, 0.83);
  check("30% less time if purged by precision, for few and medium numbers of rays", precision, 0.7);
  check("less time by precision than by position", precision, 1);
  check("as printed: 10% less time if purged by position", "printed " + position, 0.9);
  check("as printed: 17% less time if purged by precision", "printed " + precision, 0.83);
}

TEST_CASE("figure-6.12: claims on errors by purging, of ours and as printed") {
  const auto check_at = [](const std::string& words, const std::string& setting, double bound_m) {
    CAPTURE(words);
    CHECK(verdict_of("figure-6.12", words, {1000}, only(setting, 1, bound_m)) == in_all(always));
    CHECK(verdict_of("figure-6.12", words, {1000}, only(setting, 1, bound_m + 0.1)) == in_all(never));
  };
  const std::string position = "position mixed", precision = "precision 0.093 mixed";
  check_at("off by 2 m at most if purged by position", position, 2);
  check_at("off by 7 m at most by precision 0.093", precision, 7);
  check_at("as printed: off by 2 m at most if purged by position", "printed " + position, 2);
  check_at("as printed: off by 7 m at most by precision 0.093", "printed " + precision, 7);
  check_at("reasonable, within 10% of the mean path, if purged by position", position, 10);  // of 100 m
  check_at("reasonable, within 10% of the mean path, by precision 0.093", precision, 10);
  const std::string farther = "off farther by precision than by position";
  CHECK(verdict_of("figure-6.12", farther, {1000}, errors(precision, 2, position, 1)) == in_all(always));
  CHECK(verdict_of("figure-6.12", farther, {1000}, errors(precision, 1, position, 2)) == in_all(never));
  for (const std::string kind : {"", "printed "}) {
    const std::string thrice =
        (kind.empty() ? "" : "as printed: ") + std::string("on average three times as far by precision as by position");
    CHECK(verdict_of("figure-6.12", thrice, {1000}, errors(kind + precision, 6, kind + position, 2)) ==
          in_all("confirmed, a factor of 3.00"));
    CHECK(verdict_of("figure-6.12", thrice, {1000}, errors(kind + precision, 2, kind + position, 2)) ==
          in_all("not confirmed, a factor of 1.00"));
  }
}

TEST_CASE("figures 6.14 and 6.16: claims on time by hash") {
  const auto check = [](const char* figure, const char* words, const std::string& setting, double holds_s,
                        double fails_s) {
    CAPTURE(words);
    CHECK(verdict_of(figure, words, {1000}, only(setting, holds_s)).find("none") == std::string::npos);
    CHECK(verdict_of(figure, words, {1000}, only(setting, holds_s)).find("not confirmed") == std::string::npos);
    const std::string fails = verdict_of(figure, words, {1000}, only(setting, fails_s));
    CHECK((fails == in_both(never) || fails.find("not confirmed") != std::string::npos));
  };
  check("figure-6.14", "by position, Morton codes take 15% less time than the uniform hash, from 20,000 rays on",
        "position Morton", 0.8, 0.9);
  check("figure-6.14", "by position, the mixed hash takes the time of the uniform one", "position mixed", 1.04, 0.9);
  check("figure-6.14", "by precision, Morton codes take more time than no cache", "precision 0.0125 Morton", 1.1, 0.9);
  check("figure-6.14", "by precision, the uniform hash takes the time of Morton codes by position",
        "precision 0.0125 uniform", 0.95, 1.2);
  check("figure-6.14", "by precision, the mixed hash takes the time of Morton codes by position",
        "precision 0.0125 mixed", 0.95, 1.2);
  check("figure-6.16", "caches by position, and by precision with Morton codes, save no time", "position Morton", 1.1,
        0.9);
  check("figure-6.16", "by precision, the uniform hash is faster than no cache, up to 37,000 rays",
        "precision 0.0125 uniform", 0.9, 1.1);
  check("figure-6.16", "by precision, the mixed hash is faster than no cache, up to 37,000 rays",
        "precision 0.0125 mixed", 0.9, 1.1);
  // This setting is ours, not one of the thesis.
  CHECK(verdict_of("figure-6.16", "caches by position, and by precision with Morton codes, save no time", {1000},
                   only("concurrent", 0.5)) == in_both(always));
}

TEST_CASE("figures 6.15 and 6.17: claims on errors by hash and by sorting") {
  // Metres of two settings where the claim holds, and where it does not.
  const auto check = [](const char* figure, const char* words, const std::string& a, const std::string& b,
                        std::array<double, 2> holds_m, std::array<double, 2> fails_m) {
    CAPTURE(words);
    const std::string holds = verdict_of(figure, words, {1000}, errors(a, holds_m[0], b, holds_m[1])),
                      fails = verdict_of(figure, words, {1000}, errors(a, fails_m[0], b, fails_m[1]));
    CHECK((holds == in_both(always) || holds.starts_with("fixed transmitter: confirmed")));
    CHECK((fails == in_both(never) || fails.starts_with("fixed transmitter: not confirmed")));
  };
  const std::string position = "position ", precision = "precision 0.0125 ", printed = "printed ";
  check("figure-6.15", "by position, the centroid is off farther with Morton codes than with the uniform hash",
        position + "Morton", position + "uniform", {3, 2}, {2, 3});
  check("figure-6.15", "by position, on average twice as far off with Morton codes as with the uniform hash",
        position + "Morton", position + "uniform", {4.1, 2}, {2.9, 2});
  check("figure-6.15", "by position, as far with the mixed hash as with the uniform one", position + "mixed",
        position + "uniform", {2.2, 2}, {4, 2});
  check("figure-6.15", "by precision, less far with Morton codes than with the uniform hash", precision + "Morton",
        precision + "uniform", {1, 2}, {2, 1});
  check("figure-6.15", "by precision, as far with the mixed hash as with the uniform one", precision + "mixed",
        precision + "uniform", {2, 2}, {4, 2});
  check("figure-6.15",
        "as printed: by position, on average twice as far off with Morton codes as with the uniform hash",
        printed + position + "Morton", printed + position + "uniform", {4, 2}, {2, 2});
  check("figure-6.15", "as printed: by position, as far with the mixed hash as with the uniform one",
        printed + position + "mixed", printed + position + "uniform", {2, 2}, {4, 2});
  check("figure-6.15", "as printed: by precision, less far with Morton codes than with the uniform hash",
        printed + precision + "Morton", printed + precision + "uniform", {1, 2}, {2, 1});
  check("figure-6.17", "the centroid is off farther by precision than by position, with the uniform hash",
        precision + "uniform", position + "uniform", {3, 2}, {2, 3});
  check("figure-6.17", "around 5 m by precision with the uniform hash", precision + "uniform", "", {5, 0}, {9, 0});
  check("figure-6.17", "around 5 m by precision with the mixed hash", precision + "mixed", "", {5, 0}, {9, 0});
  check("figure-6.17", "sorting reduces the error by position", position + "mixed", "unsorted " + position + "mixed",
        {1, 2}, {2, 1});
  check("figure-6.17", "sorting reduces the error by precision", precision + "mixed", "unsorted " + precision + "mixed",
        {1, 2}, {2, 1});
}
