// SPDX-License-Identifier: Apache-2.0
// run --devices and --processes: one child process per device, of this same program, which share the run as ranks do.
// The parent computes nothing: it passes on messages and Ctrl-C, and reports how the children ended. A message that all
// of them print, such as one about a mistake in the configuration, is printed once.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "jobs/progress.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

// The children to start.
struct ProcessPlan {
  std::vector<std::string> arguments;  // arguments of each child
  uint32_t processes = 1;
  std::string command_line;  // as the user typed it, for the outputs
};

// Returns when all have ended: 0 if the run is complete, even if some died; 130 if it was interrupted, 5 if parts are
// missing, else the code of the first that failed. catch_interrupts() must have been called.
ExitCode start_processes(const ProcessPlan& plan, Progress& progress);

}  // namespace wavetracer
