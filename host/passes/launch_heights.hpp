// Tables of the launch "horizon": how its directions spread from the zenith (z = 1) to the nadir (z = -1). The map that
// reads them is wt_cylinder_to_heights of wavetracer/device/direction_maps.h.
#pragma once
#include <span>
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/device/direction_maps.h"

namespace wavetracer {

// A share of the directions on one side of the horizon. Their density is flat for |z| < z0 and falls as 1 / z^2 beyond:
// (1 + k) / (1 + k |z|)^2 with k = 1 / z0 - 1, which is the uniform one for z0 = 1.
struct HeightShare {
  double weight = 0;
  double z0 = 1;  // above 0, at most 1
  bool up = false;
};

constexpr uint32_t height_table_size = WT_HEIGHT_CELLS + 1;

// The table of this mixture and of a share `uniform` (0 to 1) of directions that go evenly everywhere. Weights need no
// sum of 1; with none of them everything is uniform. + - * / only: the same on every host.
std::vector<float> height_table(std::span<const HeightShare> shares, double uniform);

class LaunchHeights {
 public:
  // One table, for an antenna of which nothing is known: as on a street of a city.
  explicit LaunchHeights(gpu::Context& context);
  // One table after the other, each of height_table_size values.
  void set(const std::vector<float>& tables);
  const gpu::Buffer<float>& tables() const { return tables_; }
  const std::vector<float>& values() const { return values_; }
  // Of the first value of a table.
  uint32_t place(uint32_t table) const { return table * height_table_size; }

 private:
  gpu::Context& context_;
  std::vector<float> values_;
  gpu::Buffer<float> tables_;
};

}  // namespace wavetracer
