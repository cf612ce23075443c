// SPDX-License-Identifier: Apache-2.0
// The paths that frames without rays lacked, as the next launch shows.
#pragma once
#include "wavetracer/late.hpp"
#include "wavetracer/paths.hpp"

namespace wavetracer {

// Counts paths that were found late: every known path is among all, except those whose sequences were dropped in this
// frame.
LateCounts late_counts(const Paths& known, const Paths& all);

}  // namespace wavetracer
