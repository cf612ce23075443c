// SPDX-License-Identifier: Apache-2.0
// The numbers that the kernels of legs take (occlusion, transmissions).
#pragma once
#include "passes/device_scene.hpp"
#include "passes/solved_list.hpp"
#include "passes/step_tables.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

// Those of a scene and of the rows that are tested; the others are 0.
inline wt_legs_arguments legs_arguments(const DeviceScene& scene, const SolvedList& solved, const StepTables& steps) {
  return {.triangle_slots = scene.triangle_slots,
          .extent_m = scene.extent_m,
          .solved_count = solved.count,
          .solved_counter = solved.counter,
          .max_depth = solved.max_depth,
          .most = 0,
          .deepest = 0,
          .blocker_mask = 0,
          .tile_count = steps.tile_count(),
          .first_leg = 0,
          .open = solved.open};
}

}  // namespace wavetracer
