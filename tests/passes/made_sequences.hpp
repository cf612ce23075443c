// SPDX-License-Identifier: Apache-2.0
// Invented sequences for the tests of their set: their lengths, numbers of ends, and surfaces to meet.
#pragma once
#include <algorithm>
#include <vector>

#include "passes/exact.hpp"

namespace wavetracer::test {

inline constexpr uint32_t made_transmitters = 3, made_depth = 5;

// Returns surfaces with these normals, which is all that interact and commute need.
inline DeviceScene scene_of_normals(const std::vector<Float3>& normals) {
  DeviceScene scene;
  scene.cpu = context().info().cpu;
  std::vector<wt_surface> surfaces(normals.size());
  for (size_t i = 0; i < normals.size(); ++i) std::copy(normals[i].begin(), normals[i].end(), surfaces[i].normal);
  scene.surfaces = context().buffer(surfaces, "surfaces");
  return scene;
}

inline DeviceScene scene_of_floors(size_t count) { return scene_of_normals(std::vector<Float3>(count, {0, 0, 1})); }

}  // namespace wavetracer::test
