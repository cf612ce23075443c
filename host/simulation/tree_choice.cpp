// SPDX-License-Identifier: Apache-2.0
// Spatial splits gain up to a sixth of the tracing time in one city and lose in another, although their costs by the
// surface area heuristic hardly differ. So both trees are traced.
#include "simulation/tree_choice.hpp"

#include <algorithm>

#include "simulation/warm_sample.hpp"

namespace wavetracer {

namespace {

// The seconds that the sample's rays take on the device, warm.
double sample_seconds(gpu::Context& context, const DeviceScene& scene, const TraceConfig& sample,
                      const std::vector<glm::dvec3>& transmitters) {
  return warm_seconds(context, scene, sample, {}, transmitters,
                      [](const StageSeconds& stages) { return stage_seconds(stages, Stage::trace); });
}

}  // namespace

DeviceScene choose_tree(gpu::Context& context, const Scene& scene, const TraceConfig& config,
                        const std::vector<glm::dvec3>& transmitters, double reach_m, const std::vector<bool>& opaque) {
  DeviceScene plain = make_device_scene(context, scene, false, reach_m, opaque);
  if (config.rays.value_or(0) * transmitters.size() < tree_choice_rays) return plain;
  DeviceScene split = make_device_scene(context, scene, true, reach_m, opaque);
  TraceConfig sample = config;
  sample.rays = std::max<uint64_t>(tree_choice_rays / 32 / transmitters.size(), 1);
  return sample_seconds(context, split, sample, transmitters) < sample_seconds(context, plain, sample, transmitters)
             ? split
             : plain;
}

}  // namespace wavetracer
