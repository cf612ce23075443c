// SPDX-License-Identifier: Apache-2.0
// The order of rays for order.method = "auto": the fastest on this device, for this scene, directions and ray count.
// Paths do not depend on the order, so the choice changes only the time.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "passes/device_scene.hpp"
#include "simulation/ray_order.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

struct OrderChoice {
  OrderPlan plan;
  std::string reason;  // for the user: the measurement and its date
};

// Times one transmitter's rays with every order, or uses the result that an earlier run stored beside the compiled
// programs for the same device, scene, directions, ray count and depth. transmitters: recentred metres.
OrderChoice choose_order(gpu::Context& context, const Scene& scene, const DeviceScene& device_scene,
                         const OrderConfig& order, const LaunchConfig& launch, const TraceConfig& trace,
                         const std::vector<glm::dvec3>& transmitters);

}  // namespace wavetracer
