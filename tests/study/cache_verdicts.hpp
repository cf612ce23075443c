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

// The judgement of one claim of a figure, by its words, on made rows.
inline Judgement judgement_of_claim(const std::string& name, const std::string& words,
                                    const std::vector<uint64_t>& rays, const CacheCost& cost) {
  const Experiment& experiment = find_experiment(name);
  const CacheFigure& figure = *experiment.as<CacheFigure>();
  for (const Claim<CacheRow>& claim : figure.claims)
    if (claim.words == words)
      return judgement_of(claim, made_measurement(*experiment.study(), rays, cost).rows, figure.range);
  throw std::logic_error(name + " has no claim \"" + words + "\"");
}

// Returns the seconds and metres of one setting; all others have a second and no error.
inline CacheCost only(const std::string& setting, double seconds, double off_m = 0) {
  return [=](const std::string& one, uint64_t) {
    return one == setting ? std::pair{seconds, off_m} : std::pair{1.0, 0.0};
  };
}

inline const CacheCost same = [](const std::string&, uint64_t) { return std::pair{1.0, 0.0}; };

}  // namespace cache_verdicts
