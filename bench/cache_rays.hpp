// Rays of a real scene, segment by segment, with what the ray cache's key takes of them.
// Assumes one transmitter, and specular reflections alone.
#pragma once
#include <string>
#include <vector>

#include "passes/ray_queue.hpp"
#include "segments.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::bench {

struct Segment {
  std::vector<Ray> rays;
  std::vector<uint32_t> left, surface;  // what each ray left: its primitive and surface, WT_NONE at the transmitter
};

struct SceneRays {
  std::string name;  // of the scene
  Scene scene;
  std::vector<Segment> segments;
  size_t count() const;
};

// The segments 1 to 5 of `launched` rays: of Munich, where the shared folder has it, else of a generated city.
SceneRays scene_rays(gpu::Context& context, const std::string& shared, uint32_t launched);

// A labelled queue of region 0.
RayQueue labelled_queue(gpu::Context& context, const Segment& segment);

}  // namespace wavetracer::bench
