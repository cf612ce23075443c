// Warnings about launches: "auto" that ended before it reached trace.recall, and rays of which few met anything.
#pragma once
#include <optional>
#include <string>

#include "simulation/launch.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/missed.hpp"

namespace wavetracer {

// Empty if that is no loss: most sequences that rays meet once lead to no receiver. cold: the frame knows nothing
// of earlier ones, so that its own rays tell what is missed. missed: of the frame's paths.
std::optional<std::string> recall_warning(const DiscoveryCounts& found, const TraceConfig& trace, bool cold,
                                          const MissedCounts& missed);

// Rays that leave the world tell nothing of what they missed. Set if so few met anything that nothing can be said of
// it. surfaces: whether there is anything to meet.
std::optional<std::string> few_met_warning(const DiscoveryCounts& found, bool surfaces);

}  // namespace wavetracer
