// run --devices and --processes: one child process for each device, of this same program, which share the run as ranks
// do. The parent computes nothing: it passes on messages and Ctrl-C, and says what became of them. What all of them say
// in the same words, as a mistake that each finds, is said once.
#pragma once
#include <cstdint>
#include <string>
#include <vector>
#include "jobs/progress.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

// Children to be started.
struct ProcessPlan {
  std::vector<std::string> arguments;  // of each child
  uint32_t processes = 1;
  std::string command_line;  // as the user typed it, for the outputs
};

// Returns when all have ended: 0 where the run is whole, even if some died; 130 where it was interrupted, 5 where parts
// are missing, else the code of the first that failed. Assumes that catch_interrupts() was called.
ExitCode start_processes(const ProcessPlan& plan, Progress& progress);

}  // namespace wavetracer
