// SPDX-License-Identifier: Apache-2.0
// Elements of ends, and the frequencies and times of responses: these follow from the configuration alone.
#include "wavetracer/arrays.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "radio/carriers.hpp"
#include "radio/constants.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

std::vector<glm::dvec3> panel_m(const ArrayConfig& array, double wavelength_m) {
  const double down_m = array.vertical_spacing_m.value_or(array.vertical_spacing_wavelengths * wavelength_m);
  const double left_m = array.horizontal_spacing_m.value_or(array.horizontal_spacing_wavelengths * wavelength_m);
  std::vector<glm::dvec3> out;
  for (uint32_t column = 0; column < array.columns; ++column)
    for (uint32_t row = 0; row < array.rows; ++row)
      out.push_back({0, left_m * (column - 0.5 * (array.columns - 1)), down_m * (0.5 * (array.rows - 1) - row)});
  return out;
}

}  // namespace

std::vector<double> carriers_hz(const RadioConfig& radio) {
  if (radio.frequencies_hz.empty()) return {radio.frequency_hz};
  if (radio.frequencies_hz.front() != radio.frequency_hz)
    throw ConfigError(
        fmt::format("radio.frequency_hz = {} is not the first of radio.frequencies_hz, {}: make them equal",
                    radio.frequency_hz, radio.frequencies_hz.front()));
  return radio.frequencies_hz;
}

std::vector<glm::dvec3> element_positions_m(const Config& config, const RadioEnd& end) {
  if (end.array.empty()) return {glm::dvec3(0)};
  const auto array = std::ranges::find(config.arrays, end.array, &ArrayConfig::name);
  if (array == config.arrays.end())
    throw ConfigError(fmt::format("\"{}\": array = \"{}\": there is no [[array]] of this name", end.name, end.array));
  if (array->positions_m.empty()) return panel_m(*array, speed_of_light_m_s / config.radio.frequency_hz);
  std::vector<glm::dvec3> out;
  for (const auto& p : array->positions_m) out.push_back({p[0], p[1], p[2]});
  return out;
}

std::vector<double> response_frequencies_hz(const Config& config) {
  const ResponseConfig& response = config.response;
  std::vector<double> out;
  if (!response.bandwidth_hz) return out;
  const double spacing_hz = *response.bandwidth_hz / response.subcarriers;
  for (const double carrier_hz : carriers_hz(config.radio))
    for (uint32_t k = 0; k < response.subcarriers; ++k)
      out.push_back(carrier_hz + (static_cast<double>(k) - response.subcarriers / 2) * spacing_hz);
  return out;
}

std::vector<double> response_times_s(const Config& config) {
  std::vector<double> out;
  if (!config.response.bandwidth_hz) return out;
  for (uint32_t k = 0; k < config.response.times; ++k) out.push_back(k * config.response.time_step_s);
  return out;
}

ElementModel::ElementModel(const Config& config, const Scene& scene, std::span<const Scene> models,
                           std::span<const Instance> instances)
    : scene_(scene),
      models_(models),
      instances_(instances.begin(), instances.end()),
      carriers_hz_(wavetracer::carriers_hz(config.radio)),
      plane_(config.radio.wavefront == "plane") {
  for (const RadioEnd& end : config.transmitters)
    transmitters_.push_back({element_positions_m(config, end), ports_of(end.polarization)});
  for (const RadioEnd& end : config.receivers)
    receivers_.push_back({element_positions_m(config, end), ports_of(end.polarization)});
}

}  // namespace wavetracer
