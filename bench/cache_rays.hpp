// SPDX-License-Identifier: Apache-2.0
// Rays of a real scene, segment by segment, with the values that the ray cache's key uses.
// There is one transmitter, and only specular reflection.
#pragma once
#include <string>
#include <vector>

#include "passes/ray_queue.hpp"
#include "segments.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::bench {

struct Segment {
  std::vector<Ray> rays;
  std::vector<uint32_t> left, surface;  // the primitive and surface that each ray left, WT_NONE at the transmitter
};

struct SceneRays {
  std::string name;  // name of the scene
  Scene scene;
  std::vector<Segment> segments;
  size_t count() const;
};

// Returns the segments 1 to 5 of `launched` rays: in Munich, if the shared folder has it, else in a generated city.
SceneRays scene_rays(gpu::Context& context, const std::string& shared, uint32_t launched);

// Returns a labelled queue of region 0.
RayQueue labelled_queue(gpu::Context& context, const Segment& segment);

}  // namespace wavetracer::bench
