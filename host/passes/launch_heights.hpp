// SPDX-License-Identifier: Apache-2.0
// Tables of the launch "horizon": they say how its directions spread from the zenith (z = 1) to the nadir (z = -1).
// wt_cylinder_to_heights of wavetracer/device/direction_maps.h reads them.
#pragma once
#include <span>
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/device/direction_maps.h"

namespace wavetracer {

// A share of the directions on one side of the horizon. Their density is flat for |z| < z0 and falls as 1 / z^2 beyond:
// (1 + k) / (1 + k |z|)^2 with k = 1 / z0 - 1, which is uniform for z0 = 1.
struct HeightShare {
  double weight = 0;
  double z0 = 1;  // above 0, at most 1
  bool up = false;
};

constexpr uint32_t height_table_size = WT_HEIGHT_CELLS + 1;

// The table of this mixture and of a share `uniform` (0 to 1) of directions that are spread evenly over the sphere.
// Weights need no sum of 1; without any, all is uniform. It uses only + - * /, so it is the same on every host.
std::vector<float> height_table(std::span<const HeightShare> shares, double uniform);

class LaunchHeights {
 public:
  // Makes one table, for an antenna without known surroundings: as on a street of a city.
  explicit LaunchHeights(gpu::Context& context);
  // Sets one table after the other, each of height_table_size values.
  void set(const std::vector<float>& tables);
  const gpu::Buffer<float>& tables() const { return tables_; }
  const std::vector<float>& values() const { return values_; }
  // The place of the first value of a table.
  uint32_t place(uint32_t table) const { return table * height_table_size; }

 private:
  gpu::Context& context_;
  std::vector<float> values_;
  gpu::Buffer<float> tables_;
};

}  // namespace wavetracer
