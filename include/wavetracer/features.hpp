// What a run computes with: its device, the order of its rays, and the parts of the model that are on.
#pragma once
#include <cstdint>
#include <map>
#include <string>

namespace wavetracer {

struct DeviceSummary {
  std::string platform, name, driver, opencl_c;
  bool gpu = false;
};

// How rays were ordered and launched.
struct OrderSummary {
  std::string method = "none";  // plain name; "none" too where order.method = "auto" found no sort that pays
  bool each_depth = false;
  std::string launch_shape = "1d";
  uint32_t local_size = 0;  // 0: what suits the device
  std::string reason;       // why, where order.method = "auto"
};

// A part of the model that the configuration asks for or not, and that the scene needs or not.
struct Feature {
  bool on = false;
  std::string reason;  // why not: "trace.diffraction = false", "no edge of the scene diffracts", ...
};
// By name: the words of interaction_kinds (interaction_kinds.hpp), double_diffraction, instances. What is off runs no
// kernel.
using Features = std::map<std::string, Feature>;

}  // namespace wavetracer
