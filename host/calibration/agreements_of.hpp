// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>
#include "calibration/calibration.hpp"

namespace wavetracer::calibration {

// Returns the agreement of all points that are levels and no bounds, then of each file, transmitter and group where
// there are several. held_out: the result has values of points that were held out.
std::vector<Agreement> agreements_of(const Calibration& result, bool held_out);

}  // namespace wavetracer::calibration
