// SPDX-License-Identifier: Apache-2.0
// generate_rays: writes launch rays of one transmitter into a queue; the direction is a pure function of the launch
// index. They come in launch order, or in an order given as a list of launch indices.
#pragma once
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "kernel_calls/generate_rays.hpp"
#include "passes/launch_directions.hpp"
#include "passes/launch_heights.hpp"
#include "passes/ray_queue.hpp"
#include "passes/sample_list.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

// A transmitter that launches.
struct Launcher {
  uint32_t transmitter;
  glm::dvec3 position_m;      // recentred
  uint32_t source = WT_NONE;  // left by its rays: WT_OWN and the number of the instance that carries it
  uint32_t heights = 0;       // for directions = "horizon", or a window: its table in LaunchHeights
  bool window = false;        // the table is a window; rays start on a sphere through position_m, see directions.h
};

// A rotation of all directions about z; in windows it is in units of 2^-32 turns of their width.
struct DirectionTurn {
  float cosine = 1, sine = 0;
  uint32_t turn = 0;
};

class GenerateRays {
 public:
  // heights: those of directions = "horizon"; without them, only the first table of LaunchHeights.
  GenerateRays(gpu::Context& context, const LaunchDirections& directions,
               std::shared_ptr<const LaunchHeights> heights = {});
  // Appends `count` launch indices of this end: first, first + stride, and so on. Rays of a launch of every stride-th
  // index are numbered by index / stride.
  void operator()(RayQueue& queue, const Launcher& from, uint64_t first, uint32_t count, uint64_t stride = 1);
  // Appends the same launch indices for each of these ends, in one launch. rays_together() must divide count.
  void operator()(RayQueue& queue, std::span<const Launcher> from, uint64_t first, uint32_t count, uint64_t stride);
  uint32_t rays_together() const { return work_.per_item; }
  // Appends the launch indices first + order[0 .. count - 1]. order has 16 further elements of any value.
  void operator()(RayQueue& queue, const Launcher& from, uint64_t first, uint32_t count,
                  const gpu::Buffer<uint32_t>& order);

  // Fills the empty queue, which has the plane of samples, with samples first .. first + count - 1 of the list, and
  // sets their ends to the roots. launchers: two float4 each, see the kernel.
  void samples(RayQueue& queue, SampleList& list, uint32_t first, uint32_t count, const gpu::Buffer<float>& launchers,
               const LaunchDirections& directions, DirectionTurn turn = {});

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::generate_rays::generate_rays> generate_;
  gpu::KernelOf<calls::generate_rays::generate_launchers> generate_launchers_;
  gpu::KernelOf<calls::generate_rays::generate_ordered> generate_ordered_;
  gpu::KernelOf<calls::generate_rays::generate_samples> generate_samples_;
  LaunchDirections directions_;
  std::shared_ptr<const LaunchHeights> heights_;
  Work work_;
  gpu::Buffer<wt_launcher_arguments> launchers_;
};

}  // namespace wavetracer
