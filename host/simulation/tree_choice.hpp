// SPDX-License-Identifier: Apache-2.0
// Chooses the acceleration tree of the run, with or without spatial splits, by a timed sample of the run's own rays.
// Hits do not depend on the tree (ties go to the lower primitive), so the choice changes only the time.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "passes/device_scene.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// From this number of rays in a frame on, it pays to build two trees and sample both.
constexpr uint64_t tree_choice_rays = uint64_t{1} << 24;

// transmitters: recentred metres; reach_m, opaque: see make_device_scene.
DeviceScene choose_tree(gpu::Context& context, const Scene& scene, const TraceConfig& config,
                        const std::vector<glm::dvec3>& transmitters, double reach_m, const std::vector<bool>& opaque);

}  // namespace wavetracer
