// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "wavetracer/output.hpp"

namespace wavetracer::app {

// Says what rays may have missed, and which key finds more of it, or that it is not known; empty without rays.
std::string missed_line(const Run& run, const Totals& totals);

}  // namespace wavetracer::app
