// SPDX-License-Identifier: Apache-2.0
// Worlds with targets at 77 GHz, and their paths that go by targets.
#pragma once
#include <numbers>
#include <string>
#include <vector>

#include "simulation/run.hpp"

namespace wavetracer::test {

constexpr double radar_hz = 77e9, radar_wavelength_m = speed_of_light / radar_hz;
inline const std::vector<Quad> far_plate{{{-500, -500, -300}, {1, 0, 0}, {0, 1, 0}}};

inline Config radar_world(const SceneFile& file, const Points& from, const Points& to, uint32_t max_depth = 2) {
  Config config = config_of(file.path(), from, to, 2000, max_depth);
  config.radio.frequency_hz = radar_hz;
  config.trace.discovery = "beams";
  return config;
}

// Adds a model and a target of it.
inline void add_target(Config& config, TargetModelConfig model, const glm::dvec3& at,
                       const std::array<double, 3>& turned = {}) {
  model.name = "model" + std::to_string(config.target_models.size());
  config.targets.push_back({.name = "target" + std::to_string(config.targets.size()),
                            .model = model.name,
                            .position_m = {at.x, at.y, at.z},
                            .orientation_deg = turned,
                            .vehicle_type = {}});
  config.target_models.push_back(model);
}

// The rows of paths that go by targets.
inline std::vector<size_t> echoes(const Paths& paths) {
  std::vector<size_t> out;
  for (size_t i = 0; i < paths.target.size(); ++i)
    if (paths.target[i] != no_target) out.push_back(i);
  return out;
}

}  // namespace wavetracer::test
