// SPDX-License-Identifier: Apache-2.0
// Measures steps of a millisecond in which only some frames launch rays, compared with frames that all launch rays.
// The machine must be quiet, and sequences must be reused.
#pragma once
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer::bench {

// Prints a line: average seconds per frame, launches included, compared with frames that all launch rays. The error is
// the average share of their power that the frames without rays lack; the detail has the worst frame, and the run's own
// estimate.
void measure_continuous(const std::string& name, const Config& config, double discover_every_s,
                        const std::string& device, const std::string& command);

}  // namespace wavetracer::bench
