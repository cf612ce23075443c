// SPDX-License-Identifier: Apache-2.0
// The range of paths over edges below the other paths of their link (trace.diffraction_range_db): what it does not go
// with, and its value where the configuration leaves it to the program.
#pragma once
#include <optional>
#include <vector>

#include "config/contradictions.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::config {

void check_diffraction_range(const Config& config, std::vector<Contradiction>& out);

// Returns the range in dB, or nothing where no path is left out. trace: [trace] of the configuration, without what the
// scene does not need.
std::optional<double> diffraction_range_of(const Config& config, const TraceConfig& trace);

// In the map of docs/design/measurements.md no cell changes by more than 0.002 dB, and by 0.03 dB at most.
inline constexpr double automatic_range_db = 45;
// With this range and more, no path is left out.
inline constexpr double widest_range_db = 400;

}  // namespace wavetracer::config
