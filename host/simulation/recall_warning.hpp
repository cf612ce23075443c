// SPDX-License-Identifier: Apache-2.0
// Warnings about launches: "auto" that ended before it reached trace.recall, and launches of which few rays met
// anything.
#pragma once
#include <optional>
#include <string>

#include "simulation/launch.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/missed.hpp"

namespace wavetracer {

// Returns nothing if no path is lost: most sequences that rays meet once lead to no receiver. cold: the frame has
// nothing of earlier ones, so its own rays show what is missed. missed: that of the frame's paths.
std::optional<std::string> recall_warning(const DiscoveryCounts& found, const TraceConfig& trace, bool cold,
                                          const MissedCounts& missed);

// Rays that leave the world do not show what they missed. The warning is set if so few met anything that the loss is
// unknown. surfaces: is there anything to meet?
std::optional<std::string> few_met_warning(const DiscoveryCounts& found, bool surfaces);

}  // namespace wavetracer
