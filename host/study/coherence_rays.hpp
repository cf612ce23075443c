// coherence-rays: how far what a ray hits is what the rays hit that are launched after it, for each map of directions.
// Claims: A. Zhdanov, TU Munich, 2014, section 3.2.2 and equation 3.4.
#pragma once
#include <string>
#include <vector>
#include "study/coherence.hpp"
#include "study/recipe.hpp"

namespace wavetracer::study {

struct LagRow {
  std::string directions;  // trace.directions, whose launch order is judged
  uint32_t depth = 0;
  study::LagCoherence found;
};

std::string encode_lags(const std::vector<LagRow>& rows);
// Assumes ascending lags from 1 on for each map and depth.
Words lags_words(const std::vector<LagRow>& rows, const std::string& device);

}  // namespace wavetracer::study
