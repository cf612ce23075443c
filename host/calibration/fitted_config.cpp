// SPDX-License-Identifier: Apache-2.0
// Values are those at the carrier: laws of materials over frequency are replaced by constants.
#include "calibration/fitted_config.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "base/file.hpp"
#include "base/input_file.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::calibration {
namespace {

void set_property(MaterialConfig& material, Property property, double value) {
  switch (property) {
    case Property::permittivity:
      material.permittivity = value;
      material.a = material.b = {};
      break;
    case Property::conductivity:
      material.conductivity_s_m = value;
      material.c = material.d = {};
      break;
    case Property::thickness:
      material.thickness_m = value;
      break;
    default:
      material.scattering = value;
  }
}

}  // namespace

// A receiver is added, since a configuration in which nobody receives is an error, and removed.
Config config_of_places(const std::string& file, const std::vector<std::string>& sets) {
  check_input_file(file, "a configuration");
  Config config = parse_config(read_file(file) + "\n[[receiver]]\nname = \"measured places\"\nposition_m = [0, 0, 0]\n",
                               file, sets);
  config.receivers.edit().pop_back();
  config.text = echoed_config(config);
  return config;
}

Config fitted_config(const std::string& file, const std::vector<std::string>& sets,
                     std::span<const Parameter> parameters, std::span<const double> theta) {
  Config config = config_of_places(file, sets);
  for (size_t i = 0; i < parameters.size(); ++i) {
    auto found = std::ranges::find(config.materials, parameters[i].material, &MaterialConfig::name);
    if (found == config.materials.end()) {
      config.materials.push_back({.name = parameters[i].material});
      found = config.materials.end() - 1;
    }
    set_property(*found, parameters[i].property, parameters[i].value(theta[i]));
  }
  return config;
}

}  // namespace wavetracer::calibration
