// Predicates on rows of caches, each with rows that make it true and rows that make it false; then the claims of
// figures 6.2 to 6.17 that are made of them.
#include "study/cache_claims.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include "study/experiment.hpp"
#include "study/made_cache_rows.hpp"

using namespace wavetracer::study;

namespace {

// Of one world at one number of rays: seconds per frame and metres of the centroid.
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

// The verdicts of a figure on made rows, whose times the last argument may change.
std::vector<std::string> verdicts_of(const std::string& name, const std::vector<uint64_t>& rays, const CacheCost& cost,
                                     const std::function<void(CacheRow&)>& change = {}) {
  const Experiment& experiment = find_experiment(name);
  CacheRows rows = made_measurement(*experiment.study(), rays, cost).rows;
  if (change)
    for (CacheRow& one : rows) change(one);
  std::vector<std::string> out;
  for (const Claim<CacheRow>& claim : experiment.as<CacheFigure>()->claims) out.push_back(claim.judge(rows));
  return out;
}

using Verdicts = std::vector<std::string>;

const CacheCost same = [](const std::string&, uint64_t) { return std::pair{1.0, 0.0}; };

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
        "fixed transmitter: at 1,000 rays; moving transmitter: at none of the numbers of rays");
  CHECK(where(saves({"a"}), l2_m)(worlds) ==
        "fixed transmitter: at every number of rays; moving transmitter: no path has a vertex");
  const auto slow = [](const CacheRow& one) { return one.warm.loop_s > 0.85; };
  CHECK(of_each({"a", "b"}, slow)(two_counts) == "confirmed for \"a\", not for \"b\"");
  CHECK(of_each({"a"}, slow)(two_counts) == "confirmed for all");
  CHECK(of_each({"b"}, slow)(two_counts) == "not confirmed for any");
  CHECK(of_each({"c"}, slow)(two_counts) == "not measured");
  CHECK(of_all({"a"}, slow)(two_counts) == "confirmed");
  CHECK(of_all({"a", "b"}, slow)(two_counts) == "not confirmed");
  CHECK(of_all({"c"}, slow)(two_counts) == "not measured");
  CHECK(is_less(warm_s, "b", "a")(two_counts) == "confirmed");
  CHECK(is_less(warm_s, "a", "b")(two_counts) == "not confirmed");
}

TEST_CASE("figures 6.2, 6.3, 6.6 and 6.7: writes, reads and tracing of a segment") {
  // 80 segments are written, 100 read; nanoseconds as given.
  const auto times = [](double write, double read, double gather, double trace) {
    return [=](CacheRow& one) {
      one.cold.store_s = 80e-9 * write;
      one.cold.gather_s = 80e-9 * gather;
      one.cold.trace_s = 80e-9 * trace;
      one.warm.lookup_s = 100e-9 * read;
      if (one.setting.starts_with("chained")) one.cold.store_s *= 2;
    };
  };
  CHECK(verdicts_of("figure-6.2", {50000}, same, times(30, 20, 1, 0)) ==
        Verdicts{"confirmed for all", "confirmed for all"});
  CHECK(verdicts_of("figure-6.2", {50000}, same, times(5, 20, 5, 0)) ==
        Verdicts{"not confirmed for any", "not confirmed for any"});
  CHECK(verdicts_of("figure-6.3", {50000}, same, times(10, 20, 1, 210)) ==
        Verdicts{"confirmed for all", "confirmed for all", "confirmed for all"});
  CHECK(verdicts_of("figure-6.3", {50000}, same, times(10, 20, 1, 15)) ==
        Verdicts{"not confirmed for any", "not confirmed for any", "not confirmed for any"});
  CHECK(verdicts_of("figure-6.6", {50000}, same, times(30, 20, 1, 0)) ==
        Verdicts{"confirmed for all", "confirmed", "not confirmed"});  // reads take as long in both
  CHECK(verdicts_of("figure-6.7", {50000}, same, times(300, 20, 1, 210)) ==
        Verdicts{"confirmed for all", "confirmed for all", "not confirmed for any"});
}

TEST_CASE("figure-6.9: a gain beyond 16,000 rays, of a mutex alone") {
  const auto with = [](const std::string& winner) {
    return [winner](const std::string& setting, uint64_t rays) {
      return std::pair{setting == winner && rays > 16000 ? 0.9 : 1.0, 0.0};
    };
  };
  CHECK(verdicts_of("figure-6.9", {1000, 32000}, with("mutex Morton")) == Verdicts{"confirmed"});
  CHECK(verdicts_of("figure-6.9", {1000, 32000}, with("concurrent")) == Verdicts{"not confirmed"});
  CHECK(verdicts_of("figure-6.9", {1000, 16000}, with("mutex Morton")) == Verdicts{"not measured"});
}

TEST_CASE("figures 6.14 to 6.17: hash functions") {
  const std::string never = "at none of the numbers of rays", always = "at 1,000 rays";
  const auto both = [](const std::string& words) {
    return "fixed transmitter: " + words + "; fixed transmitter, reception by spheres: " + words;
  };
  const auto as_claimed = [](const std::string& setting, uint64_t) {
    if (setting == "position Morton") return std::pair{0.8, 4.2};
    if (setting == "position uniform") return std::pair{1.0, 2.0};
    if (setting == "precision 0.0125 Morton") return std::pair{1.1, 1.0};
    if (setting == "precision 0.0125 uniform") return std::pair{0.9, 5.0};
    return std::pair{1.0, 0.0};
  };
  CHECK(verdicts_of("figure-6.14", {1000}, as_claimed) == Verdicts{both(always), both(always)});
  CHECK(verdicts_of("figure-6.15", {1000}, as_claimed) == Verdicts{both(always), both(always), both(always)});
  CHECK(verdicts_of("figure-6.16", {1000}, as_claimed) == Verdicts{both(always), both(always)});
  CHECK(verdicts_of("figure-6.17", {1000}, as_claimed) == Verdicts{both(always)});
  CHECK(verdicts_of("figure-6.14", {1000}, same) == Verdicts{both(never), both(never)});
  CHECK(verdicts_of("figure-6.15", {1000}, same) == Verdicts{both(never), both(never), both(never)});
  CHECK(verdicts_of("figure-6.16", {1000}, same) == Verdicts{both(never), both(never)});
  CHECK(verdicts_of("figure-6.17", {1000}, same) == Verdicts{both(never)});
  // Ours is not one of the thesis'.
  const auto ours_alone = [](const std::string& setting, uint64_t) {
    return std::pair{setting == "concurrent" ? 0.5 : 1.0, 0.0};
  };
  CHECK(verdicts_of("figure-6.16", {1000}, ours_alone).front() == both(never));
}
