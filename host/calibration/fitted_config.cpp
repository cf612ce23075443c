// SPDX-License-Identifier: Apache-2.0
// Values are those at the carrier: laws of materials over frequency are replaced by constants.
#include "calibration/fitted_config.hpp"
#include <algorithm>
#include <array>
#include "base/file.hpp"
#include "base/input_file.hpp"
#include "scene/material_checks.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::calibration {
namespace {

MaterialConfig& entry_of(Config& config, const std::string& name) {
  const auto bare = [](const std::string& text) { return spellings(text)[2]; };
  const auto found =
      std::ranges::find_if(config.materials, [&](const MaterialConfig& each) { return bare(each.name) == bare(name); });
  if (found != config.materials.end()) return *found;
  config.materials.push_back({.name = name});
  return config.materials.back();
}

// A wall of one layer is a slab, whose law is that of its layer. A table has constants or a law over frequency, and not
// a half of either.
void set_constants(Config& config, const std::string& name, const device::wt_material& record, double frequency_hz) {
  MaterialConfig& material = entry_of(config, name);
  if (!material.layers.empty())
    return set_constants(config, std::string(material.layers[0].material), record, frequency_hz);
  material.permittivity = value_of(record, Property::permittivity, frequency_hz);
  material.conductivity_s_m = value_of(record, Property::conductivity, frequency_hz);
  material.a = material.b = material.c = material.d = {};
}

void set_property(Config& config, const Parameter& parameter, const device::wt_material& record, double frequency_hz) {
  if (parameter.property == Property::permittivity || parameter.property == Property::conductivity)
    return set_constants(config, parameter.owner, record, frequency_hz);
  const double value = value_of(record, parameter.property, frequency_hz);
  MaterialConfig& material = entry_of(config, parameter.owner);
  if (parameter.property == Property::scattering)
    material.scattering = value;
  else
    (material.layers.empty() ? material.thickness_m.emplace() : material.layers[0].thickness_m) = value;
}

void set_end(Config& config, const Parameter& parameter, const EndPlaces& fitted) {
  if (parameter.transmitter == no_end) {
    for (RadioEnd& end : config.receivers.edit())
      (end.position_wgs84 ? (*end.position_wgs84)[2] : end.position_m[2]) += fitted.receivers_rise_m;
    return;
  }
  const TransmitterPlace& place = fitted.transmitters[parameter.transmitter];
  RadioEnd& end = config.transmitters.edit()[parameter.transmitter];
  const auto numbers = [](const glm::dvec3& of) { return std::array{of.x, of.y, of.z}; };
  if (is_angle(parameter.property)) {
    end.orientation_deg = numbers(place.yaw_pitch_roll_deg);
  } else {
    end.position_m = numbers(place.position_m);
    end.position_wgs84.reset();
    end.above = "zero";
  }
}

}  // namespace

// A receiver is added, since a configuration in which nobody receives is an error, and removed.
Config config_of_places(const std::string& file, const std::vector<std::string>& sets) {
  check_input_file(file, "a configuration");
  Config config = parse_config(read_file(file) + "\n[[receiver]]\nname = \"measured places\"\nposition_m = [0, 0, 0]\n",
                               file, sets);
  config.receivers.edit().pop_back();
  config.radars.clear();  // measured places have none
  config.text = echoed_config(config);
  return config;
}

Config fitted_config(Config config, const Inputs& fitted, double frequency_hz, std::span<const Parameter> parameters) {
  for (const Parameter& parameter : parameters)
    if (is_of_end(parameter.property))
      set_end(config, parameter, fitted.ends);
    else
      set_property(config, parameter, fitted.materials[parameter.records.front()], frequency_hz);
  return config;
}

}  // namespace wavetracer::calibration
