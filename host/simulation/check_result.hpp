// SPDX-License-Identifier: Apache-2.0
// The result of one check of a device.
#pragma once
#include <string>

namespace wavetracer {

struct CheckResult {
  std::string name;  // name of the checked part
  bool passed = false;
  std::string found;   // in words: "37 of 1,000 rays hit the wrong triangle"
  double seconds = 0;  // includes compiling
};

}  // namespace wavetracer
