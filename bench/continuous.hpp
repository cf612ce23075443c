// Steps of a millisecond with rays launched every so often, beside frames that all launch rays.
// Assumes a quiet machine, and sequences that are reused.
#pragma once
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer::bench {

// Prints a line: seconds per frame on average, launches included, against frames that all launch rays. The error is the
// share of their power that the frames without rays lack, on average; the detail has the worst frame, and what the run
// itself says of it.
void measure_continuous(const std::string& name, const Config& config, double discover_every_s,
                        const std::string& device, const std::string& command);

}  // namespace wavetracer::bench
