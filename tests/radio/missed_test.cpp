// SPDX-License-Identifier: Apache-2.0
// Estimates of missed paths, compared with launches whose truth is known: drawn at random, over sequences of many
// sizes.
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

  // Adds a path that these quarters found; 0: it is missed.
  void add(uint32_t depth, uint8_t quarters, double of_power) {
    if (quarters == 0) {
      ++missed;
      missed_power += of_power;
      return;
    }
    power += of_power;
    found.depth.push_back(depth);
    found.delay_s.push_back(1e-6);
    found.a.push_back({std::sqrt(of_power)});
    found.quarters.push_back(quarters);
  }
};

// Each of `count` paths is met by a ray of each quarter with a probability of its own, from 1 down over decades.
Launch simulated(uint32_t count, double decades, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  Launch out;
  const auto power = [&] { return std::pow(10, -2 * uniform(random)); };
  out.add(0, 15, power());
  for (uint32_t i = 0; i < count; ++i) {
    // Mean number of rays that a quarter sends there.
    const double rays = std::pow(10, 1.5 - decades * uniform(random));
    uint8_t quarters = 0;
    for (int q = 0; q < 4; ++q) quarters |= static_cast<uint8_t>((uniform(random) > std::exp(-rays)) << q);
    out.add(2, quarters, power());
  }
  return out;
}

MissedCounts counts(const Launch& launch) { return missed_counts(launch.found, 0, launch.found.size()); }

bool holds(const MissedRange& range, double truth) { return range.low <= truth && truth <= range.high; }

}  // namespace

TEST_CASE(
    "of simulated launches the intervals hold the truth in nine cases of ten, and the estimates are near in the mean") {
  for (const double decades : {1.5, 2.0, 2.5})
    for (const uint32_t count : {20u, 200u, 2000u}) {
      CAPTURE(decades);
      CAPTURE(count);
      int paths_held = 0, power_held = 0;
      double estimated = 0, truth = 0, power_estimated = 0, power_truth = 0;
      constexpr int launches = 100;
      for (uint32_t seed = 0; seed < launches; ++seed) {
        const Launch launch = simulated(count, decades, seed);
        const Missed missed = estimate_missed(counts(launch));
        paths_held += holds(missed.paths, static_cast<double>(launch.missed));
        power_held += holds(missed.power_share, launch.missed_power / launch.power);
        estimated += missed.paths.estimate;
        truth += static_cast<double>(launch.missed);
        power_estimated += missed.power_share.estimate;
        power_truth += launch.missed_power / launch.power;
      }
      CHECK(paths_held >= 90);
      CHECK(power_held >= 90);
      CAPTURE(estimated);
      CAPTURE(truth);
      CHECK(estimated > truth / 2);
      CHECK(estimated < 2 * truth + launches);
      CAPTURE(power_estimated);
      CAPTURE(power_truth);
      CHECK(power_estimated > power_truth / 2);
      CHECK(power_estimated < 2 * power_truth + static_cast<double>(launches) / count);  // one path per launch
    }
}

TEST_CASE("where strong paths are easy to find, the power is that of paths which are as hard to find as the missed") {
  // Powers fall with the probability of being found, as those of long paths do; the mean over rare paths is too large.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  int near = 0, launches = 0;
  for (int repetition = 0; repetition < 200; ++repetition) {
    Launch launch;
    for (int i = 0; i < 500; ++i) {
      const double rays = std::pow(10, 1 - 2 * uniform(random)), power = 1e-9 * rays * rays * uniform(random);
      uint8_t quarters = 0;
      for (int q = 0; q < 4; ++q) quarters |= static_cast<uint8_t>((uniform(random) > std::exp(-rays)) << q);
      launch.add(2, quarters, power);
    }
    const double truth = launch.missed_power / launch.power;
    const double estimate = estimate_missed(counts(launch)).power_share.estimate;
    if (launch.missed == 0) continue;
    ++launches;
    near += estimate <= 3 * truth && truth <= 3 * estimate;
  }
  CAPTURE(near);
  CHECK(launches == 200);
  // Compared with the mean of all launches that one or two quarters found: a fifth of them.
  CHECK(near >= 0.7 * launches);
}

TEST_CASE("the estimate of the formula, by hand") {
  // By one of four at p = 1/4 each: (3/4)^4 missed for 1 - (3/4)^4 found; by two 1/16 for 15/16; by three 1/256 for
  // 255.
  const Missed missed =
      estimate_missed({.frames = 1, .paths = {60, 30, 20, 90}, .powers = {6, 3, 2, 40}, .amplitude = 80, .power = 100});
  const double found = 60 * 81.0 / 175 + 30 / 15.0 + 20 / 255.0, power = 6 * 81.0 / 175 + 3 / 15.0 + 2 / 255.0;
  const double chance = 1.96 * std::sqrt(60 * std::pow(81.0 / 175, 2) + 30 / 225.0 + 20 / (255.0 * 255));
  // Chao's 3/8 f1^2 / f2 against 81 / 175 f1, the latter as good as five observations.
  const double likeness = (0.375 * 60 * 175 / 81 + 5) / (30 + 5);
  const double few = 60 - 1.96 * std::sqrt(60.0);
  CHECK(missed.paths.estimate == doctest::Approx(likeness * found));
  CHECK(missed.paths.low == std::floor(0.375 * few * few / (31 + 1.96 * std::sqrt(30.0))));
  CHECK(missed.paths.low > 15);
  CHECK(missed.paths.high == doctest::Approx(3 * likeness * (found + chance) + 3));
  CHECK(missed.power_share.estimate == doctest::Approx(likeness * power / 100));
  CHECK(missed.power_share.low == doctest::Approx(power / found * missed.paths.low / 100 / 5));
  CHECK(missed.power_share.high == doctest::Approx(likeness * power / 100 * 5 + 3 * 0.4 * 0.4 / 100));
}

TEST_CASE("where nothing rare was seen, three paths of the mean amplitude may be missed") {
  const Missed missed =
      estimate_missed({.frames = 1, .paths = {0, 0, 0, 8}, .powers = {0, 0, 0, 4}, .amplitude = 4, .power = 10});
  CHECK(missed.paths.estimate == 0);
  CHECK(missed.paths.low == 0);
  CHECK(missed.paths.high == 3);
  CHECK(missed.power_share.estimate == 0);
  CHECK(missed.power_share.low == 0);
  CHECK(missed.power_share.high == doctest::Approx(3 * 0.25 / 10));
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
  CHECK(of.powers == std::array<double, 4>{2, 1, 1, 0});
  CHECK(of.amplitude == 4);
  CHECK(missed_counts(paths, 1, 2).paths == std::array<uint64_t, 4>{1, 0, 0, 0});
  paths.quarters.clear();
  CHECK(missed_counts(paths, 0, 5).frames == 0);
}

TEST_CASE("a drive of like frames misses as many paths in each; parts of a frame are one frame") {
  const MissedCounts frame{
      .frames = 1, .paths = {60, 3, 2, 9}, .powers = {0.6, 0.3, 0.1, 3}, .amplitude = 8, .power = 10};
  MissedCounts drive;
  for (int i = 0; i < 5; ++i) add(drive, frame);
  const Missed one = estimate_missed(frame), five = estimate_missed(drive);
  CHECK(drive.frames == 5);
  CHECK(five.paths.estimate == doctest::Approx(5 * one.paths.estimate));
  CHECK(five.paths.high == doctest::Approx(5 * one.paths.high));
  CHECK(one.paths.low > 0);
  CHECK(five.paths.low == doctest::Approx(5 * one.paths.low));
  CHECK(five.power_share.estimate == doctest::Approx(one.power_share.estimate));
  CHECK(five.power_share.low == doctest::Approx(one.power_share.low));
  CHECK(five.power_share.high == doctest::Approx(one.power_share.high));
  MissedCounts parts;
  for (int i = 0; i < 2; ++i) add_part(parts, frame);
  CHECK(parts.frames == 1);
  CHECK(parts.paths == std::array<uint64_t, 4>{120, 6, 4, 18});
  CHECK(parts.powers == std::array<double, 4>{1.2, 0.6, 0.2, 6});
  CHECK(parts.amplitude == 16);
  CHECK(parts.power == 20);
}
