// SPDX-License-Identifier: Apache-2.0
// Values are those at the carrier: laws of materials over frequency are replaced by constants.
#include "calibration/fitted_config.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <string_view>
#include "base/file.hpp"
#include "base/input_file.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::calibration {
namespace {

// The name without the prefixes that may be left out.
std::string_view bare(std::string_view name) {
  for (const std::string_view prefix : {"mat-", "itu_"})
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  return name;
}

MaterialConfig& entry_of(Config& config, const std::string& name) {
  const auto found =
      std::ranges::find_if(config.materials, [&](const MaterialConfig& each) { return bare(each.name) == bare(name); });
  if (found != config.materials.end()) return *found;
  config.materials.push_back({.name = name});
  return config.materials.back();
}

// A wall of one layer is a slab, whose law is that of its layer.
void set_property(Config& config, const std::string& name, Property property, double value) {
  MaterialConfig& material = entry_of(config, name);
  const bool layered = !material.layers.empty();
  switch (property) {
    case Property::permittivity:
      if (layered) return set_property(config, material.layers[0].material, property, value);
      material.permittivity = value;
      material.a = material.b = {};
      break;
    case Property::conductivity:
      if (layered) return set_property(config, material.layers[0].material, property, value);
      material.conductivity_s_m = value;
      material.c = material.d = {};
      break;
    case Property::thickness:
      (layered ? material.layers[0].thickness_m : material.thickness_m.emplace()) = value;
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
  for (size_t i = 0; i < parameters.size(); ++i)
    set_property(config, parameters[i].material, parameters[i].property, parameters[i].value(theta[i]));
  return config;
}

}  // namespace wavetracer::calibration
