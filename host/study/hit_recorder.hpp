// What every ray of a launch hit, depth by depth: the wavefront loop with its hits read back to the host.
// Assumes few rays: one batch, and every plane of the queue is copied at every depth.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>
#include "passes/generate_rays.hpp"
#include "passes/interact.hpp"
#include "passes/scan.hpp"
#include "passes/sequences.hpp"
#include "passes/trace.hpp"
#include "study/coherence.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

// A static scene on a device, for experiments that look at single passes.
struct TracedScene {
  // transmitters_m: all that will launch rays, file coordinates.
  TracedScene(const Config& config, const std::string& device_text, const std::vector<glm::dvec3>& transmitters_m);

  gpu::Context context;
  Scene scene;
  DeviceScene on_device;
  DeviceSummary device;
};

class HitRecorder {
 public:
  // Takes rays, directions, seed and max_depth of `trace`. `traced` must outlive it.
  HitRecorder(TracedScene& traced, const TraceConfig& trace);
  // Hits of the rays of a transmitter, file coordinates; their points are recentred.
  FrameHits operator()(const glm::dvec3& transmitter_m);

 private:
  TracedScene& traced_;
  uint32_t ray_count_, max_depth_;
  GenerateRays generate_;
  Trace trace_;
  Scan scan_;
  Interact interact_;
  Sequences sequences_;  // interact fills it; nobody asks for it, so it may overflow
  RayQueue rays_, next_;
  HitList hits_;
  void record(std::vector<Hit>& at, std::vector<uint32_t>& launch_index) const;
};

}  // namespace wavetracer::study
