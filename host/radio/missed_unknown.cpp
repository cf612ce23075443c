// SPDX-License-Identifier: Apache-2.0
// Two of the reasons are in the configuration; for the third the frame has a warning with numbers.
#include "radio/missed_unknown.hpp"

namespace wavetracer {

std::string missed_unknown_reason(const Config& config) {
  if (config.trace.by_spheres()) return "the spheres of receivers catch no exact paths";
  if (config.cache.on()) return "the answers of a ray cache are no independent rays";
  return "the rays do not show it, as a warning says; a higher number of trace.rays does, and trace.discovery = "
         "\"beams\" misses none";
}

}  // namespace wavetracer
