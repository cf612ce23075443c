// What to say of a launch of trace.rays = "auto" that ended before it found what trace.recall asks for.
#pragma once
#include <optional>
#include <string>

#include "simulation/launch.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/missed.hpp"

namespace wavetracer {

// Nothing where that is no loss: most sequences that rays meet once lead to no receiver. cold: the frame knows nothing
// of earlier ones, so that its own rays tell what is missed. missed: of the frame's paths.
std::optional<std::string> recall_warning(const DiscoveryCounts& found, const TraceConfig& trace, bool cold,
                                          const MissedCounts& missed);

}  // namespace wavetracer
