// SPDX-License-Identifier: Apache-2.0
// occlusion: marks solved paths that have an obstructed leg.
// kernels/lib/leg.clh has the rule.
#pragma once
#include "kernel_calls/occlusion.hpp"
#include "passes/blockers.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/step_tables.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class Occlusion {
 public:
  Occlusion(gpu::Context& context, const DeviceScene& scene);
  // blockers: stores the triangles that hide paths; null: they are not stored.
  void operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, Counters& counters,
                  Blockers* blockers = nullptr, const StepTables& steps = {});

 private:
  Work work_;
  bool packets_;
  gpu::KernelOf<calls::occlusion::occlusion> kernel_;
};

}  // namespace wavetracer
