// SPDX-License-Identifier: Apache-2.0
// Warnings about launches: "auto" that ended before it reached trace.recall, and launches that do not show what they
// missed.
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

// Whole houses fit between rays that are far apart, and no ray shows that they are there. The warning is set if
// neighbouring rays are too far apart at the other end of a link. rays_each: those of each transmitter that the frame
// knows of, its own and those of earlier frames.
std::optional<std::string> far_apart_warning(const DiscoveryCounts& found, double rays_each);

// Says for one frame after the other whether its rays show what they missed.
class RayWitness {
 public:
  // found: of this frame. cold: it knows nothing of earlier frames. Returns the warning, where rays do not show it.
  std::optional<std::string> hear(const DiscoveryCounts& found, bool cold, bool surfaces);
  // Do the rays show it in this frame? One without rays is as the frame before it.
  bool tells() const { return tells_; }

 private:
  double rays_each_ = 0;
  bool tells_ = true;
};

}  // namespace wavetracer
