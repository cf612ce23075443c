// What every ray of a launch hit, depth by depth, read back to the host: it follows the rays of a discovery.
// Assumes few rays: planes of the queue are copied at every depth.
#pragma once
#include <glm/vec3.hpp>
#include <string>
#include <vector>
#include "simulation/discovery.hpp"
#include "study/coherence.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

// A static scene on a device, for experiments that look at rays instead of paths.
struct TracedScene {
  // transmitters_m: all that will launch rays, file coordinates.
  TracedScene(const Config& config, const std::string& device_text, const std::vector<glm::dvec3>& transmitters_m);

  gpu::Context context;
  Scene scene;
  DeviceScene on_device;
  DeviceSummary device;
};

class HitRecorder final : public RayFollower {
 public:
  // Takes rays, directions, seed and max_depth of `trace`; rays are reflected, and nothing else. `traced` must outlive
  // it.
  HitRecorder(TracedScene& traced, const TraceConfig& trace);
  // Hits of the rays of a transmitter, file coordinates; their points are recentred.
  FrameHits operator()(const glm::dvec3& transmitter_m);

 private:
  void begin_batch(std::vector<LaunchPart> parts) override { parts_ = std::move(parts); }
  void follow(const RayQueue& rays, const HitList& hits, uint32_t depth,
              const std::optional<AnsweredRays>& answered) override;
  // Of a sample of the batch.
  uint64_t launch_index(uint32_t sample) const;

  TracedScene& traced_;
  TraceConfig trace_;
  Discovery discovery_;
  std::vector<LaunchPart> parts_;
  FrameHits found_;
};

}  // namespace wavetracer::study
