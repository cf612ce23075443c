// SPDX-License-Identifier: Apache-2.0
// The settings of a run's computation: its device, the order of its rays, and the features (interactions) that are on.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace wavetracer {

struct DeviceSummary {
  std::string platform, name, driver, opencl_c;
  bool gpu = false;
};

// The order and the launch of rays.
struct OrderSummary {
  std::string method = "none";  // plain name; also "none" if order.method = "auto" found that no sort saves time
  bool each_depth = false;
  std::string launch_shape = "1d";
  std::optional<uint32_t> local_size = {};  // not set: chosen for the device
  std::string reason;                       // why this method was chosen, with order.method = "auto"
};

// A feature: it is on if the configuration asks for it and the scene needs it.
struct Feature {
  bool on = false;
  std::string reason;  // why it is off: "trace.diffraction = false", "no edge of the scene diffracts", ...
};
// Keys are the words of interaction_kinds (interaction_kinds.hpp), double_diffraction, scattering_reflections and
// instances. A feature that is
// off runs no kernel.
using Features = std::map<std::string, Feature>;

}  // namespace wavetracer
