// SPDX-License-Identifier: Apache-2.0
// Kernels in the frames that need them (frame_worlds.hpp), with the work of those frames (kernel_costs.hpp).
#pragma once
#include <set>
#include <string>
#include <vector>

#include "kernel_rows.hpp"

namespace wavetracer::bench {

struct FrameOptions {
  std::string device, shared;       // as for wavetracer run; the folder of scenes/munich
  std::vector<std::string> worlds;  // only these, if any is named
  uint64_t rays = 0;                // per transmitter
  size_t vehicles = 0;              // those of the drive
};

// Runs the worlds that rows still need: a kernel gets its row in its own world, or in a later one if that does not
// launch it on this device. Returns the names of all kernels that ran.
std::set<std::string> measure_frame_kernels(KernelRows& rows, const FrameOptions& options);

}  // namespace wavetracer::bench
