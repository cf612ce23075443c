// SPDX-License-Identifier: Apache-2.0
// Compares the hit of a ray with those of rays that are launched after it, for each map of directions.
// A. Zhdanov, TU Munich, 2014, section 3.2.2 and equation 3.4.
#pragma once
#include <string>
#include <vector>
#include "base/csv_columns.hpp"
#include "study/coherence.hpp"

namespace wavetracer::study {

struct LagRow {
  std::string directions;  // trace.directions, whose launch order is judged
  uint32_t depth = 0;
  LagCoherence found;
};

const Columns<LagRow>& lag_columns();

}  // namespace wavetracer::study
