// Which acceleration tree the run gets: with spatial splits or without, by a timed sample of the run's own rays.
// Hits do not depend on the tree (ties go to the lower primitive), so the choice changes time only.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "passes/device_scene.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Launches a frame of at least this many rays pay for building two trees and sampling both.
constexpr uint64_t tree_choice_rays = uint64_t{1} << 24;

// transmitters: recentred metres; reach_m, opaque: see make_device_scene.
DeviceScene choose_tree(gpu::Context& context, const Scene& scene, const TraceConfig& config,
                        const std::vector<glm::dvec3>& transmitters, double reach_m, const std::vector<bool>& opaque);

}  // namespace wavetracer
