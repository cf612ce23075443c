// SPDX-License-Identifier: Apache-2.0
// transmissions: enters the surfaces that solved paths pass through into their rows, in order along the path. It
// replaces occlusion: it marks paths that pass more surfaces than they may, or an opaque one.
#pragma once
#include "kernel_calls/transmissions.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/step_tables.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class Transmissions {
 public:
  // most: the most transmissions of a path. deepest: the most interactions of all kinds of a path with transmissions;
  // it is limited by the room in a row of the list.
  Transmissions(gpu::Context& context, const DeviceScene& scene, uint32_t most, uint32_t deepest = UINT32_MAX);
  void operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, Counters& counters,
                  const StepTables& steps = {});

 private:
  uint32_t most_, deepest_;
  Work work_;
  gpu::KernelOf<calls::transmissions::transmissions> kernel_;
};

}  // namespace wavetracer
