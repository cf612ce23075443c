// coherence-rays: how far what a ray hits is what the rays hit that are launched after it, for each map of directions.
// Claims: A. Zhdanov, TU Munich, 2014, section 3.2.2 and equation 3.4.
#pragma once
#include <string>
#include <vector>
#include "recipes/recipe.hpp"
#include "report/coherence.hpp"

namespace wavetracer::recipes {

struct LagRow {
  std::string directions;  // trace.directions, whose launch order is judged
  uint32_t depth = 0;
  report::LagCoherence found;
};

std::string encode_lags(const std::vector<LagRow>& rows);
// Assumes ascending lags from 1 on for each map and depth.
Words lags_words(const std::vector<LagRow>& rows, const std::string& device);

}  // namespace wavetracer::recipes
