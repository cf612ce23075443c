// SPDX-License-Identifier: Apache-2.0
// Verdicts of the figures of caches on rows that a test makes.
#pragma once
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>
#include "study/cache_claims.hpp"
#include "study/experiment.hpp"
#include "study/made_cache_rows.hpp"

namespace cache_verdicts {

using namespace wavetracer::study;

// The verdicts of a figure on made rows, whose times the last argument may change.
inline std::vector<std::string> verdicts_of(const std::string& name, const std::vector<uint64_t>& rays,
                                            const CacheCost& cost, const std::function<void(CacheRow&)>& change = {}) {
  const Experiment& experiment = find_experiment(name);
  CacheRows rows = made_measurement(*experiment.study(), rays, cost).rows;
  if (change)
    for (CacheRow& one : rows) change(one);
  std::vector<std::string> out;
  for (const Claim<CacheRow>& claim : experiment.as<CacheFigure>()->claims) out.push_back(claim.judge(rows).words);
  return out;
}

// The verdict on one claim of a figure, by its words.
inline Judgement judgement_of(const std::string& name, const std::string& words, const std::vector<uint64_t>& rays,
                              const CacheCost& cost) {
  const Experiment& experiment = find_experiment(name);
  for (const Claim<CacheRow>& claim : experiment.as<CacheFigure>()->claims)
    if (claim.words == words) return claim.judge(made_measurement(*experiment.study(), rays, cost).rows);
  throw std::logic_error(name + " has no claim \"" + words + "\"");
}
inline std::string verdict_of(const std::string& name, const std::string& words, const std::vector<uint64_t>& rays,
                              const CacheCost& cost) {
  return judgement_of(name, words, rays, cost).words;
}

// Returns the seconds and metres of one setting; all others have a second and no error.
inline CacheCost only(const std::string& setting, double seconds, double off_m = 0) {
  return [=](const std::string& one, uint64_t) {
    return one == setting ? std::pair{seconds, off_m} : std::pair{1.0, 0.0};
  };
}

// Metres of two settings.
inline CacheCost errors(const std::string& a, double a_m, const std::string& b, double b_m) {
  return [=](const std::string& one, uint64_t) { return std::pair{1.0, one == a ? a_m : one == b ? b_m : 0.0}; };
}

// Returns the words for the worlds of figures 6.14 to 6.17, and of 6.10 to 6.12.
inline std::string in_both(const std::string& words) {
  return "fixed transmitter: " + words + "; moving transmitters, reception by spheres: " + words;
}
inline std::string in_all(const std::string& words) {
  return "fixed transmitter: " + words + "; moving transmitters: " + words +
         "; moving transmitters, reception by spheres: " + words;
}

inline const std::string never = "at none of the numbers of rays", always = "at 1,000 rays";

using Verdicts = std::vector<std::string>;

inline const CacheCost same = [](const std::string&, uint64_t) { return std::pair{1.0, 0.0}; };

}  // namespace cache_verdicts
