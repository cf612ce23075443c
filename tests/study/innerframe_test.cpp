// SPDX-License-Identifier: Apache-2.0
// Tests coherence inside a frame: the control equation against counted cells and rays, and each claim with rows that
// make it true and rows that make it false.
#include <doctest/doctest.h>
#include <cmath>
#include <random>
#include <set>
#include "study/control_equation.hpp"
#include "study/experiment.hpp"
#include "study/innerframe_claims.hpp"
#include "study/made_cache_rows.hpp"
#include "study/run.hpp"
#include "wavetracer/device/cache.h"

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

const std::vector<std::string> names = {"a", "b"};

// A row at this C_E, of 1,000 segments.
CacheRow row_at(const std::string& setting, uint64_t rays, double error, double groups, double shared) {
  CacheRow row{.setting = setting, .rays = rays, .division = control_division(rays, error)};
  row.counts = {.segments = 1000, .lookups = 1000, .hits = 0, .groups = groups, .shared = shared};
  row.error.lost_share = 0;
  return row;
}

CacheRow with_loss(CacheRow row, double lost_share) {
  row.error.lost_share = lost_share;
  return row;
}

CacheRow with_saving(CacheRow row, double percent) {
  row.saved_percent = percent;
  return row;
}

}  // namespace

TEST_CASE("the control equation's C_E is the root of the rays that a launch has in a cell of directions") {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  constexpr uint64_t rays = 200000;
  for (const double error : {2.0, 4.0, 8.0}) {
    const uint32_t division = control_division(rays, error);
    CHECK(control_error(rays, division) == doctest::Approx(error).epsilon(0.03));
    std::set<uint64_t> cells;
    for (uint64_t i = 0; i < rays; ++i) {
      const double x = normal(random), y = normal(random), z = normal(random),
                   length = std::sqrt(x * x + y * y + z * z);
      cells.insert(device::wt_cache_cells(static_cast<float>(x / length), static_cast<float>(y / length),
                                          static_cast<float>(z / length), division));
    }
    // Cells are cut by the sphere into parts of any size, so that small ones stay without a ray.
    CHECK(static_cast<double>(cells.size()) < 1.02 * direction_cells(division));
    CHECK(static_cast<double>(cells.size()) > 0.8 * direction_cells(division));
  }
  CHECK(control_division(10, 1e6) == 1);
}

TEST_CASE("claim: of a group one ray is traced") {
  const auto outcome = [](double groups, double shared) {
    return outcome_of(one_ray_a_group({"a"})({row_at("a", 1000, 1, groups, shared)}));
  };
  CHECK(outcome(300, 700) == ClaimOutcome::reproduced);
  CHECK(outcome(300, 600) == ClaimOutcome::refuted);  // 400 were traced
  CHECK(outcome(0, 1000) == ClaimOutcome::refuted);
  CHECK(outcome(299, 700) == ClaimOutcome::undecided);
  CHECK(one_ray_a_group({"b"})({row_at("a", 1000, 1, 300, 700)}).all.empty());
}

TEST_CASE("claim: coherence inside the frame saves time") {
  CacheRow none{.setting = "no cache", .rays = 1000};
  none.warm = {.loop_s = 1};
  none.warm_error.loop_s = 0.001;
  CacheRow faster = with_saving(row_at("a", 1000, 1, 300, 700), 10);
  faster.warm = {.loop_s = 0.9};
  faster.warm_error.loop_s = 0.001;
  none.drive = faster.drive = "still";
  const auto outcome = [&](const CacheRow& row, double lost) {
    return outcome_of(somewhere_faster(names, lost)({none, row}));
  };
  CHECK(outcome(faster, 1) == ClaimOutcome::reproduced);
  CHECK(outcome(with_saving(faster, -10), 1) == ClaimOutcome::refuted);
  CHECK(outcome(with_saving(faster, 0.1), 1) == ClaimOutcome::undecided);
  CHECK(outcome(with_loss(faster, 0.02), 0.01) == ClaimOutcome::refuted);
  CHECK(somewhere_faster({"c"}, 1)({none, faster}).all.empty());
}

TEST_CASE("claims of Popov: how many times fewer rays") {
  const CacheRow few = row_at("a", 1000, 1, 10, 990), many = row_at("a", 1000, 1, 500, 500);
  const auto words = [](const CacheRows& rows) { return words_of(fewer_traced_times(50)(rows)); };
  CHECK(words({many, few}) == "yes (up to 100 times)");
  CHECK(words({many}) == "no (up to 2.00 times)");
  CHECK(words({row_at("a", 1000, 1, 0, 0)}) == "not measured");
}

TEST_CASE("claim: a larger C_E errs more, by more than the paths' number leaves open") {
  CacheRow fine = with_loss(row_at("a", 100000, 1, 1, 1), 0.01), coarse = with_loss(row_at("a", 100000, 4, 1, 1), 0.1);
  fine.error.reference_paths = coarse.error.reference_paths = 1000;
  const auto outcome = [](const CacheRow& a, const CacheRow& b) { return outcome_of(error_grows(names)({a, b})); };
  CHECK(outcome(coarse, fine) == ClaimOutcome::reproduced);
  CHECK(outcome(with_loss(coarse, 0.001), with_loss(fine, 0.05)) == ClaimOutcome::refuted);
  CHECK(outcome(with_loss(coarse, 0.011), fine) == ClaimOutcome::undecided);
}

TEST_CASE("claim: at equal C_E the error is the same whatever the number of rays") {
  CacheRow few = with_loss(row_at("a", 100000, 2, 1, 1), 0.01), many = with_loss(row_at("a", 900000, 2, 1, 1), 0.02);
  few.error.reference_paths = many.error.reference_paths = 100000;
  const auto outcome = [](const CacheRow& a, const CacheRow& b) {
    return outcome_of(error_is_controlled(names, 3, 1e-3)({a, b}));
  };
  CHECK(outcome(few, many) == ClaimOutcome::reproduced);
  CHECK(outcome(few, with_loss(many, 0.04)) == ClaimOutcome::refuted);
  CHECK(outcome(few, with_loss(many, 0.03)) == ClaimOutcome::undecided);
  CHECK(outcome(with_loss(few, 0), with_loss(many, 5e-4)) == ClaimOutcome::reproduced);
}

TEST_CASE("innerframe: settings group by the control equation, at random and in order; every frame is alone") {
  for (const std::string name : {"innerframe", "innerframe-ordered"}) {
    const CacheStudy& study = *find_experiment(name).study();
    CHECK(study.empty_tables);
    std::set<uint32_t> divisions;
    for (size_t i = 0; i < study.settings.size(); ++i) {
      Config config = experiment_config(find_experiment(name), "", {});
      config.trace.rays = 50000;
      uncached(config);
      study.settings[i].apply(config);
      CHECK(config.trace.directions.word() == (name == "innerframe" ? "random" : "hilbert"));
      CHECK(config.cache.on() == (i > 0));
      if (i == 0) continue;
      CHECK(config.cache.innerframe == (study.settings[i].name != "no groups"));
      CHECK(config.cache.own_points() == (study.settings[i].name == "groups with own hit points"));
      divisions.insert(config.cache.division);
    }
    CHECK(divisions.contains(10));  // 50,000 rays in cells of a tenth: a hundred in each
    CHECK(divisions.size() == 6);
  }
}

TEST_CASE("innerframe: the page has a row for each setting and number of rays, with its groups") {
  const Experiment& experiment = find_experiment("innerframe");
  CacheMeasurement measured = made_measurement(*experiment.study(), {10000, 50000}, [](const std::string&, uint64_t) {
    return std::pair{1.0, 0.5};
  });
  for (CacheRow& row : measured.rows) {
    row.counts = {.segments = 1000, .lookups = 1000, .hits = 10, .groups = 90, .shared = 900};
    row.division = 10;
  }
  const Findings found = show(experiment, measured, {});
  CHECK(found.words.numbers.rows.size() == 2 * experiment.study()->settings.size());
  CHECK(found.words.numbers.rows[1][5] == "90");
  CHECK(found.words.numbers.rows[1][6] == "90");
  CHECK(found.words.numbers.rows[1][7] == "900");
  CHECK(found.words.verdicts.size() == 7);
}
