// SPDX-License-Identifier: Apache-2.0
// Tests claims of single figures of caches, each with rows that make it true and rows that make it false.
// Numbers are chosen so that the verdicts are known by hand.
#include <doctest/doctest.h>
#include <cmath>
#include "study/cache_claims.hpp"
#include "study/cache_verdicts.hpp"

using namespace wavetracer::study;
using namespace cache_verdicts;

namespace {

const std::string by_position = "position ", by_precision = "precision 0.0125 ";

// Seconds of settings by name; a second of all others.
CacheCost taking(const std::vector<std::pair<std::string, double>>& seconds) {
  return [seconds](const std::string& setting, uint64_t) {
    for (const auto& [name, s] : seconds)
      if (name == setting) return std::pair{s, 0.0};
    return std::pair{1.0, 0.0};
  };
}

// Returns seconds of one setting at 1,000 rays, and at all other numbers of rays.
CacheCost growing(const std::string& setting, double few_s, double many_s) {
  return [=](const std::string& one, uint64_t rays) {
    return std::pair{one == setting ? (rays == 1000 ? few_s : many_s) : 1.0, 0.0};
  };
}

}  // namespace

TEST_CASE("figure-6.8: the time of no cache up to 50,000 rays, Morton codes the slowest beyond") {
  const char *alike = "the time of no cache, within 10%, up to 50,000 rays",
             *slowest = "Morton codes are the slowest of the three beyond 50,000 rays";
  CHECK(verdict_of("figure-6.8", alike, {1000, 64000}, growing("readers mixed", 1.09, 2)) == "confirmed");
  CHECK(verdict_of("figure-6.8", alike, {1000, 64000}, growing("readers mixed", 1.11, 1)) == "not confirmed");
  CHECK(verdict_of("figure-6.8", alike, {1000, 64000}, growing("readers mixed", 0.89, 1)) == "not confirmed");
  CHECK(verdict_of("figure-6.8", alike, {64000}, same) == "not measured");
  CHECK(verdict_of("figure-6.8", slowest, {1000, 64000}, growing("readers Morton", 0.5, 1.1)) == "confirmed");
  CHECK(verdict_of("figure-6.8", slowest, {1000, 64000}, growing("readers mixed", 0.5, 1.1)) == "not confirmed");
}

TEST_CASE("figure-6.8: a gain from fewer rays on than with the chained table") {
  const std::string words = "a gain from fewer rays on than with the chained table, with the mixed hash";
  const auto gaining = [](uint64_t open_from, uint64_t chained_from) {
    return [=](const std::string& setting, uint64_t rays) {
      const bool gains =
          (setting == "readers mixed" && rays >= open_from) || (setting == "chained mixed" && rays >= chained_from);
      return std::pair{gains ? 0.9 : 1.0, 0.0};
    };
  };
  const std::vector<uint64_t> rays = {1000, 16000, 64000};
  CHECK(verdict_of("figure-6.8", words, rays, gaining(16000, 64000)) ==
        "confirmed, from 16,000 rays on; the other from 64,000 rays on");
  CHECK(verdict_of("figure-6.8", words, rays, gaining(16000, 99999)) ==
        "confirmed, from 16,000 rays on; the other nowhere");
  CHECK(verdict_of("figure-6.8", words, rays, gaining(64000, 64000)) ==
        "not confirmed, from 64,000 rays on; the other from 64,000 rays on");
  CHECK(verdict_of("figure-6.8", words, rays, gaining(99999, 99999)) == "not confirmed, nowhere; the other nowhere");
  CHECK(gains_earlier("readers mixed", "absent")(
            made_measurement(*find_experiment("figure-6.8").study(), rays, same).rows) == "not measured");
}

TEST_CASE("figure-6.9: most seconds are saved at 2,048,000 rays") {
  const char* words = "most seconds are saved at 2,048,000 rays";
  const auto saving = [](double at_bound_s, double beyond_s) {
    return [=](const std::string& setting, uint64_t rays) {
      const double cost = setting == "mutex mixed" ? 1 - (rays == 2048000 ? at_bound_s : beyond_s) : 1.0;
      return std::pair{cost, 0.0};
    };
  };
  CHECK(verdict_of("figure-6.9", words, {1000, 2048000, 4096000}, saving(0.5, 0.2)) == "confirmed");
  CHECK(verdict_of("figure-6.9", words, {1000, 2048000, 4096000}, saving(0.2, 0.5)) == "not confirmed");
  CHECK(verdict_of("figure-6.9", words, {1000, 2048000}, saving(-0.1, -0.2)) == "not confirmed");  // nothing is saved
  CHECK(verdict_of("figure-6.9", words, {1000, 64000}, saving(0.5, 0.2)) == "not measured");
}

TEST_CASE("figure-6.11: constantly less time, and a difference that grows") {
  const char *less_time = "constantly less time than no cache if purged by position",
             *grows = "the difference grows with the number of rays if purged by position";
  CHECK(verdict_of("figure-6.11", less_time, {1000}, only(by_position + "mixed", 0.9)) == in_all(always));
  CHECK(verdict_of("figure-6.11", less_time, {1000}, only(by_position + "mixed", 1.1)) == in_all(never));
  CHECK(verdict_of("figure-6.11", "less time than no cache if purged by precision", {1000},
                   only(by_precision + "mixed", 1.1)) == in_all(never));
  CHECK(verdict_of("figure-6.11", grows, {1000, 49000}, growing(by_position + "mixed", 0.9, 0.85)) ==
        in_all("confirmed, 10% less time at 1,000 rays and 15% less time at 49,000"));
  CHECK(verdict_of("figure-6.11", grows, {1000, 49000}, growing(by_position + "mixed", 0.85, 0.9)) ==
        in_all("not confirmed, 15% less time at 1,000 rays and 10% less time at 49,000"));
  CHECK(verdict_of("figure-6.11", grows, {1000}, same) == in_all("not measured"));
}

TEST_CASE("figure-6.12: far off at the first number of rays") {
  for (const std::string kind : {"", "printed "}) {
    const std::string words = (kind.empty() ? "" : "as printed: ") +
                              std::string("off by some 8 m if purged by position, at the first number of rays");
    const auto off = [&](double few_m, double many_m) {
      return [=](const std::string& setting, uint64_t rays) {
        return std::pair{1.0, setting == kind + by_position + "mixed" ? (rays == 1000 ? few_m : many_m) : 0.0};
      };
    };
    CHECK(verdict_of("figure-6.12", words, {1000, 49000}, off(7.5, 1)) == in_all("confirmed, 7.50 m"));
    CHECK(verdict_of("figure-6.12", words, {1000, 49000}, off(1, 7.5)) == in_all("not confirmed, 1.00 m"));
  }
}

TEST_CASE("figure-6.14: ranks of hash functions by time") {
  const std::string saved = "the second worst is no cache: all others save time";
  const auto others = [](double last_s) {
    return taking({{by_position + "uniform", 0.9},
                   {by_position + "Morton", 0.9},
                   {by_position + "mixed", 0.9},
                   {by_precision + "uniform", 0.9},
                   {by_precision + "mixed", last_s}});
  };
  CHECK(verdict_of("figure-6.14", saved, {1000}, others(0.9)) == in_both(always));
  CHECK(verdict_of("figure-6.14", saved, {1000}, others(1.1)) == in_both(never));
  const auto check = [](const std::string& words, const std::string& setting, double holds_s, double fails_s) {
    CAPTURE(words);
    const std::string holds = verdict_of("figure-6.14", words, {1000}, only(setting, holds_s)),
                      fails = verdict_of("figure-6.14", words, {1000}, only(setting, fails_s));
    CHECK((holds == in_both(always) || holds.starts_with("fixed transmitter: confirmed")));
    CHECK((fails == in_both(never) || fails.starts_with("fixed transmitter: not confirmed")));
  };
  check("by precision, Morton codes take the most time of all", by_precision + "Morton", 1.1, 0.9);
  check("by position, the uniform hash takes less time than no cache", by_position + "uniform", 0.9, 1.1);
  check("by precision, the mixed hash takes the time of the uniform one", by_precision + "mixed", 1.04, 1.1);
  check("Morton codes by position take less time than the uniform hash by precision, for many rays",
        by_position + "Morton", 0.9, 1.1);
}

TEST_CASE("figure-6.15: ranks of hash functions by error") {
  const std::string worst = "by precision, the uniform and the mixed hash are off farthest of all",
                    better = "Morton codes are off less far by position than by precision";
  CHECK(verdict_of("figure-6.15", worst, {1000}, errors(by_precision + "uniform", 5, by_precision + "mixed", 4)) ==
        in_both(always));
  CHECK(verdict_of("figure-6.15", worst, {1000}, errors(by_precision + "uniform", 5, by_position + "mixed", 4)) ==
        in_both(never));
  CHECK(verdict_of("figure-6.15", worst, {1000}, same) == in_both(never));  // nothing is off
  CHECK(verdict_of("figure-6.15", better, {1000}, errors(by_precision + "Morton", 5, by_position + "Morton", 4)) ==
        in_both(always));
  CHECK(verdict_of("figure-6.15", better, {1000}, errors(by_precision + "Morton", 4, by_position + "Morton", 5)) ==
        in_both(never));
}

TEST_CASE("figure-6.16: what reordering gains without a cache, and caches that lose at many rays") {
  const std::string gain = "without a cache, reordering gives 2.5 times the speed at 49,000 rays";
  CHECK(verdict_of("figure-6.16", gain, {1000}, only("unsorted no cache", 2.6)) == in_both(always));
  CHECK(verdict_of("figure-6.16", gain, {1000}, only("unsorted no cache", 2.4)) == in_both(never));
  for (const std::string hash : {"uniform", "mixed"}) {
    const std::string words =
        "by precision, the " + hash + " hash takes noticeably more time than no cache at 61,000 rays";
    CHECK(verdict_of("figure-6.16", words, {1000}, only(by_precision + hash, 1.1)) == in_both(always));
    CHECK(verdict_of("figure-6.16", words, {1000}, only(by_precision + hash, 1.01)) == in_both(never));
  }
}
