// SPDX-License-Identifier: Apache-2.0
// Records what every ray of a launch hit, depth by depth, on the host: it follows the rays of a discovery. Rays should
// be few: planes of the queue are copied at every depth.
#pragma once
#include <optional>
#include <string>
#include <vector>
#include "simulation/discovery.hpp"
#include "simulation/placement.hpp"
#include "simulation/world.hpp"
#include "study/coherence.hpp"
#include "study/coherence_frames.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::study {

// A world on a device, for experiments that use rays instead of paths.
struct TracedWorld {
  TracedWorld(const Config& config, const std::string& device_text);

  gpu::Context context;
  Scene scene;
  World world;
  DeviceScene on_device;
  std::optional<InstancePlacement> placement;  // set if there are vehicles
  DeviceSummary device;
};

// See plan_drive() of coherence_frames.hpp.
Drive plan_drive(const TracedWorld& traced, uint32_t frames, uint32_t least, const std::string& where);

class HitRecorder final : public RayFollower {
 public:
  // Uses rays, directions, seed and max_depth of `trace`; rays are only reflected. `traced` must outlive this object.
  HitRecorder(TracedWorld& traced, const TraceConfig& trace);
  // Returns hits of the rays of a transmitter in a frame of the world; their points are recentred. The vehicle that
  // carries it does not block its rays.
  FrameHits operator()(uint32_t transmitter, uint32_t frame);

 private:
  void begin_batch(std::vector<LaunchPart> parts) override { parts_ = std::move(parts); }
  void follow(const RayQueue& rays, const HitList& hits, uint32_t depth,
              const std::optional<AnsweredRays>& answered) override;
  // Returns the launch index of a sample of the batch.
  uint64_t launch_index(uint32_t sample) const;

  TracedWorld& traced_;
  TraceConfig trace_;
  Discovery discovery_;
  std::vector<LaunchPart> parts_;
  FrameHits found_;
};

}  // namespace wavetracer::study
