// SPDX-License-Identifier: Apache-2.0
// vegetation: the lengths of visible paths inside of each kind of vegetation of the scene. It is made where a scene has
// any. Rays and exact paths do not depend on it: leaves neither turn nor stop a wave.
#pragma once
#include "kernel_calls/vegetation.hpp"
#include "passes/counters.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/tuning.hpp"
#include "radio/vegetation_law.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer {

class Vegetation {
 public:
  Vegetation(gpu::Context& context, const VolumeTable& table);
  // Returns metres, kind by kind for one path after the other.
  const gpu::Buffer<double>& operator()(const RadioEnds& ends, const SolvedList& visible, Counters& counters);

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::vegetation::vegetation> kernel_;
  Work work_;
  uint32_t kinds_;
  gpu::Buffer<wt_bvh2_node> nodes_;
  gpu::Buffer<device::wt_volume> volumes_;  // in the order of leaves of the tree
  gpu::Buffer<double> triangles_, lengths_;
  gpu::Buffer<uint32_t> earlier_;
};

}  // namespace wavetracer
