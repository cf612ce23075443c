// transmissions: enters the surfaces that solved paths pass through into their rows, in order along the path.
// Takes the place of occlusion: marks paths that pass more surfaces than they may, or one that nothing passes.
#pragma once
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/step_tables.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class Transmissions {
 public:
  // most: transmissions of a path. deepest: interactions of all kinds of a path with transmissions, or as many as a row
  // of the list has room for, if these are fewer.
  Transmissions(gpu::Context& context, const DeviceScene& scene, uint32_t most, uint32_t deepest = UINT32_MAX);
  void operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, Counters& counters,
                  const StepTables& steps = {});

 private:
  uint32_t most_, deepest_;
  Work work_;
  gpu::Kernel kernel_;
};

}  // namespace wavetracer
