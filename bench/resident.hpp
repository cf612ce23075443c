// SPDX-License-Identifier: Apache-2.0
// The memory that this process has in use.
#pragma once
#include <fstream>
#include <string>

#include "wavetracer/error.hpp"

namespace wavetracer::bench {

// Returns the resident memory of this process, as Linux counts it.
inline double resident_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) * 1024;
  throw RuntimeError("/proc/self/status has no VmRSS: the case \"memory\" needs Linux");
}

}  // namespace wavetracer::bench
