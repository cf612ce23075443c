// The result of one check of a device.
#pragma once
#include <string>

namespace wavetracer {

struct CheckResult {
  std::string name;  // of what was checked
  bool passed = false;
  std::string found;   // in words: "37 of 1,000 rays hit the wrong triangle"
  double seconds = 0;  // compiling included
};

}  // namespace wavetracer
