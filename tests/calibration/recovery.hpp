// SPDX-License-Identifier: Apache-2.0
// Levels of a world that is known are measured values of another one: helpers of the tests that find it again.
#pragma once
#include <random>
#include <string>
#include <vector>

#include "app/program.hpp"
#include "calibration/calibration.hpp"
#include "radio/links.hpp"
#include "simulation/run.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::test {

// Places 1.5 m above the ground, on both sides of the line y = 0.
inline std::vector<glm::dvec3> places_along_street(size_t count, uint32_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> along(-45, 45), across(-9, 9);
  std::vector<glm::dvec3> out;
  for (size_t i = 0; i < count; ++i) out.push_back({along(random), across(random), 1.5});
  return out;
}

// The path gains of the links of a configuration's first frame, dB, in the order of links.
inline std::vector<double> path_gains(const Config& config) {
  Simulation simulation(config);
  const FrameResult frame = simulation.run_frame(0);
  std::vector<double> out;
  for (const LinkFigures& link : link_figures(frame.paths, 0, frame.world.links, config.radio.frequency_hz))
    out.push_back(link.path_gain_db);
  return out;
}

// The gains of these places, dB, in their order.
inline std::vector<double> gains(const Folder& folder, const std::string& text, const std::vector<glm::dvec3>& at) {
  std::string all = text;
  for (size_t i = 0; i < at.size(); ++i)
    all += fmt::format("[[receiver]]\nname = \"r{:04}\"\nposition_m = [{}, {}, {}]\n", i, at[i].x, at[i].y, at[i].z);
  return path_gains(load_config(folder.file("true.toml", all)));
}

inline std::string table(const std::vector<glm::dvec3>& at, const std::vector<double>& levels) {
  std::string out = "x_m,y_m,z_m,path_gain_db\n";
  for (size_t i = 0; i < at.size(); ++i)
    out += fmt::format("{:.17g},{:.17g},{},{:.17g}\n", at[i].x, at[i].y, at[i].z, levels[i]);
  return out;
}

inline calibration::Calibration calibrated(const std::string& config, const std::string& measured,
                                           calibration::Offsets offsets, std::vector<std::string> patterns = {"*"},
                                           uint32_t folds = 4) {
  const calibration::Request request{.config = config,
                                     .sets = {},
                                     .measured = {measured},
                                     .level = "",
                                     .device = "",
                                     .patterns = std::move(patterns),
                                     .offsets = offsets,
                                     .folds = folds};
  return calibration::calibrate(request, {[](const std::string&) {}, [] { return false; }});
}

inline double fitted(const calibration::Calibration& result, const std::string& name) {
  for (size_t p = 0; p < result.parameters.size(); ++p)
    if (result.parameters[p].name() == name) return result.parameters[p].value(result.fit.theta[p]);
  FAIL("no parameter " << name);
  return 0;
}

// The gains, dB, that the fitted configuration gives at these places once it was written and read again.
inline std::vector<double> gains_of_fitted(const calibration::Calibration& result, const std::vector<glm::dvec3>& at) {
  Config again = result.config;
  for (size_t i = 0; i < at.size(); ++i)
    again.receivers.push_back({fmt::format("r{:04}", i), {at[i].x, at[i].y, at[i].z}});
  return path_gains(parse_config(resolved_config(again), "fitted.toml"));
}

}  // namespace wavetracer::test
