// SPDX-License-Identifier: Apache-2.0
// The cost of one kernel: its share of a profile.
#pragma once
#include <cstdint>
#include <map>
#include <string>

namespace wavetracer {

struct KernelTime {
  double seconds = 0;  // by the device's clock
  uint64_t launches = 0;
  uint64_t items = 0;  // work-items that were asked for, without those that fill the last work-group
};

// By "program/kernel", as in "refine/mark"; the program is a file's name in a folder of kernels/.
using KernelTimes = std::map<std::string, KernelTime>;

}  // namespace wavetracer
