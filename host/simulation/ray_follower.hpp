// SPDX-License-Identifier: Apache-2.0
// An observer of rays besides the set of sequences, batch by batch and depth by depth. This one records nothing;
// RayTrails records receptions and waypoints.
#pragma once
#include <optional>
#include <vector>

#include "passes/ray_queue.hpp"

namespace wavetracer {

// Samples of one transmitter that follow each other in a batch. Sample first_sample + k has launch index first_index +
// k * stride, and is number first + k of the `launched` samples of its transmitter, of which some are chosen for the
// output.
struct LaunchPart {
  uint32_t transmitter, first_sample, count;
  uint64_t first, launched;
  uint64_t first_index, stride = 1;
};

// Rays, some of which a cache has answered, see Receive.
struct AnsweredRays {
  const gpu::Buffer<float>& traced;        // WT_NONE where the cache answered
  const gpu::Buffer<uint32_t>* receivers;  // receivers that their segments passed, where entries keep them; else null
  bool vehicles;                           // entries also contain hits on vehicles; else vehicles are always traced
};

class RayFollower {
 public:
  virtual ~RayFollower() = default;
  // The number of segments that it needs after the last interaction of a ray.
  virtual uint32_t extra_segments() const { return 0; }
  // Returns the device memory that it needs for each sample of a batch, including room for the batch.
  virtual uint64_t bytes_per_sample() const { return 0; }
  virtual void reserve(uint64_t /*samples*/) {}
  // The launch begins, or begins again: drops all data of this launch.
  virtual void begin_launch() {}
  // Labelled rays of these parts follow, and none of an earlier call; also if the batch before is traced again.
  virtual void begin_batch(std::vector<LaunchPart> /*parts*/) {}
  // Gets rays that have had `depth` interactions, and their hits. answered: set if a cache was asked.
  virtual void follow(const RayQueue& /*rays*/, const HitList& /*hits*/, uint32_t /*depth*/,
                      const std::optional<AnsweredRays>& /*answered*/) {}
  virtual void end_batch() {}
};

}  // namespace wavetracer
