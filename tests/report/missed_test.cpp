// Estimates of what was missed, against launches whose truth is known: drawn at random, over sequences of many sizes.
#include "wavetracer/missed.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "wavetracer/paths.hpp"

using namespace wavetracer;

namespace {

struct Launch {
  Paths found;
  uint64_t missed = 0;
  double missed_power = 0, power = 0;
};

// Each of `count` paths is met by a ray of each quarter with a probability of its own, from 1 down over decades.
Launch simulated(uint32_t count, double decades, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  Launch out;
  const auto add = [&](uint32_t depth, uint8_t quarters) {
    const double power = std::pow(10, -2 * uniform(random));
    if (quarters == 0) {
      ++out.missed;
      out.missed_power += power;
      return;
    }
    out.power += power;
    out.found.depth.push_back(depth);
    out.found.delay_s.push_back(1e-6);
    out.found.a.push_back({std::sqrt(power)});
    out.found.quarters.push_back(quarters);
  };
  add(0, 15);
  for (uint32_t i = 0; i < count; ++i) {
    const double rays = std::pow(10, 1.5 - decades * uniform(random));  // that a quarter sends there in the mean
    uint8_t quarters = 0;
    for (int q = 0; q < 4; ++q) quarters |= static_cast<uint8_t>((uniform(random) > std::exp(-rays)) << q);
    add(2, quarters);
  }
  return out;
}

MissedCounts counts(const Launch& launch) { return missed_counts(launch.found, 0, launch.found.size()); }

bool holds(const MissedRange& range, double truth) { return range.low <= truth && truth <= range.high; }

}  // namespace

TEST_CASE(
    "of simulated launches the intervals hold the truth in nine cases of ten, and the estimate is near in the mean") {
  for (const double decades : {1.5, 2.0, 2.5})
    for (const uint32_t count : {20u, 200u, 2000u}) {
      CAPTURE(decades);
      CAPTURE(count);
      int paths_held = 0, power_held = 0;
      double estimated = 0, truth = 0;
      constexpr int launches = 100;
      for (uint32_t seed = 0; seed < launches; ++seed) {
        const Launch launch = simulated(count, decades, seed);
        const Missed missed = estimate_missed(counts(launch));
        paths_held += holds(missed.paths, static_cast<double>(launch.missed));
        power_held += holds(missed.power_share, launch.missed_power / launch.power);
        estimated += missed.paths.estimate;
        truth += static_cast<double>(launch.missed);
      }
      CHECK(paths_held >= 90);
      CHECK(power_held >= 90);
      CAPTURE(estimated);
      CAPTURE(truth);
      CHECK(estimated > truth / 2);
      CHECK(estimated < 2 * truth + launches);
    }
}

TEST_CASE("the estimate of the formula, by hand") {
  const Missed missed = estimate_missed(
      {.frames = 1, .paths = {60, 30, 20, 90}, .rare_power = 9, .found_power = 40, .power = 100});
  const double few = 60 - 1.96 * std::sqrt(60.0), many = 60 + 1.96 * std::sqrt(60.0);
  CHECK(missed.paths.estimate == doctest::Approx(0.5 * 3600 / 31));
  CHECK(missed.paths.low == std::floor(0.375 * few * few / (31 + 1.96 * std::sqrt(30.0))));
  CHECK(missed.paths.low > 15);
  CHECK(missed.paths.high == doctest::Approx(1.5 * many * many / 31));
  CHECK(missed.power_share.estimate == doctest::Approx(missed.paths.estimate * 0.1 / 100));
  CHECK(missed.power_share.low == doctest::Approx(missed.paths.low * 0.1 / 100 / 5));
  CHECK(missed.power_share.high == doctest::Approx(missed.paths.high * 0.1 / 100 * 5));
}

TEST_CASE("where nothing was missed by any quarter, three paths of the mean power may be missed") {
  const Missed missed = estimate_missed({.frames = 1, .paths = {0, 0, 0, 8}, .found_power = 4, .power = 10});
  CHECK(missed.paths.estimate == 0);
  CHECK(missed.paths.low == 0);
  CHECK(missed.paths.high == 3);
  CHECK(missed.power_share.estimate == 0);
  CHECK(missed.power_share.high == doctest::Approx(3 * 0.5 / 10 * 5));
}

TEST_CASE("lines of sight are not counted; what no quarter found alone is as rare as what one did") {
  Paths paths;
  paths.depth = {0, 1, 2, 2, 3};
  paths.delay_s.assign(5, 0);
  paths.a.assign(5, {1.0});
  paths.quarters = {15, 0b0000, 0b0100, 0b1010, 0b0111};
  const MissedCounts of = missed_counts(paths, 0, 5);
  CHECK(of.frames == 1);
  CHECK(of.paths == std::array<uint64_t, 4>{2, 1, 1, 0});
  CHECK(of.power == 5);
  CHECK(of.found_power == 4);
  CHECK(of.rare_power == 3);
  CHECK(missed_counts(paths, 1, 2).paths == std::array<uint64_t, 4>{1, 0, 0, 0});
  paths.quarters.clear();
  CHECK(missed_counts(paths, 0, 5).frames == 0);
}

TEST_CASE("a drive of like frames misses as many paths in each; parts of a frame are one frame") {
  const MissedCounts frame{.frames = 1, .paths = {6, 3, 2, 9}, .rare_power = 0.9, .found_power = 4, .power = 10};
  MissedCounts drive;
  for (int i = 0; i < 5; ++i) add(drive, frame);
  const Missed one = estimate_missed(frame), five = estimate_missed(drive);
  CHECK(drive.frames == 5);
  CHECK(five.paths.estimate == doctest::Approx(5 * one.paths.estimate));
  CHECK(five.paths.high == doctest::Approx(5 * one.paths.high));
  CHECK(five.power_share.estimate == doctest::Approx(one.power_share.estimate));
  MissedCounts parts;
  for (int i = 0; i < 2; ++i) add_part(parts, frame);
  CHECK(parts.frames == 1);
  CHECK(parts.paths == std::array<uint64_t, 4>{12, 6, 4, 18});
  CHECK(parts.power == 20);
}
