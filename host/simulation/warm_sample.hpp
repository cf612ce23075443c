// SPDX-License-Identifier: Apache-2.0
// A function that choices by measurement share: the time that discovery takes once it is warm. No other code may use
// the context's profile meanwhile.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "simulation/discovery.hpp"

namespace wavetracer {

// The better of two warm runs over a sample of rays; seconds_of turns a run's stages into one number.
template <class SecondsOf>
double warm_seconds(gpu::Context& context, const DeviceScene& scene, const TraceConfig& sample, const OrderPlan& plan,
                    const std::vector<glm::dvec3>& transmitters, const SecondsOf& seconds_of) {
  Discovery discovery(context, scene, sample, {.order = plan});
  double best = 0;
  for (int run = 0; run < 3; ++run) {
    context.reset_profile();
    discovery.sequences().clear();
    discovery.find(scene, {.who = launchers(transmitters), .rays = *sample.rays});
    const double seconds = seconds_of(context.profile());
    if (run == 1 || (run > 1 && seconds < best)) best = seconds;  // the first is cold
  }
  return best;
}

}  // namespace wavetracer
