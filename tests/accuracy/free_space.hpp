// SPDX-License-Identifier: Apache-2.0
// Configurations of masts and grids, studies of their samples, and gains of free space.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "accuracy/chances.hpp"
#include "radio/constants.hpp"
#include "simulation/run.hpp"

namespace wavetracer::test {

inline constexpr double carrier_hz = 5.9e9, cell_height_m = 1.5;

inline std::string antenna(const std::string& name, const glm::dvec3& at) {
  return fmt::format("[[transmitter]]\nname = \"{}\"\nposition_m = [{}, {}, {}]\n", name, at.x, at.y, at.z);
}

inline std::string grid(const std::string& name, double x_min_m, double x_max_m, double step_m) {
  return fmt::format(
      "[[receiver_grid]]\nname = \"{}\"\nx_min_m = {}\nx_max_m = {}\ny_min_m = -1.0\ny_max_m = 1.0\nstep_m = {}\n"
      "height_m = {}\nabove = \"zero\"\n",
      name, x_min_m, x_max_m, step_m, cell_height_m);
}

inline std::string head(const SceneFile& scene, const std::string& trace) {
  return fmt::format(
      "scene.file = \"{}\"\n[radio]\nfrequency_hz = {}\ntransmit_power_dbm = 20.0\nbandwidth_hz = 1e7\n{}",
      scene.path().string(), carrier_hz, "[trace]\n" + trace);
}

// A small surface that is far away, so that all is free space.
inline SceneFile free_space() { return SceneFile({Quad{{-900, -900, -400}, {2, 0, 0}, {0, 2, 0}}}); }

inline accuracy::ChanceStudy studied(const std::string& file, std::vector<std::string> thresholds, uint32_t samples,
                                     const accuracy::InputErrors& errors, std::vector<std::string> sets = {}) {
  const accuracy::ChanceRequest request{
      .inputs = {.file = file, .sets = std::move(sets), .device = "", .samples = samples, .seed = 7, .errors = errors},
      .thresholds = std::move(thresholds),
      .grid = "",
      .tx = ""};
  return accuracy::study_chances(request, {[](const std::string&) {}, [] { return false; }});
}

inline double gain_db(double distance_m) {
  return 20 * std::log10(speed_of_light_m_s / carrier_hz / (4 * std::acos(-1.0) * distance_m));
}

inline double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

inline double deviation_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::pow(value - mean_of(values), 2);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

inline double share_from(const std::vector<double>& values, double least) {
  return static_cast<double>(std::ranges::count_if(values, [&](double value) { return value >= least; })) /
         static_cast<double>(values.size());
}

}  // namespace wavetracer::test
