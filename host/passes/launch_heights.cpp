// SPDX-License-Identifier: Apache-2.0
// A table is the inverse of the share of directions above z; the share is summed up on a grid that is fine at the
// horizon.
#include "passes/launch_heights.hpp"

#include <algorithm>
#include <cstddef>

namespace wavetracer {

namespace {

constexpr double street_z0 = 0.01;  // both ends 3 m above the ground, 300 m apart
constexpr double street_uniform = 0.25;

constexpr int grid_steps = 320;         // steps on each side
constexpr double grid_ratio = 0.96875;  // from 1 to 4e-5

// The share of one side's directions that are between the horizon and |z|.
double below(double z0, double z) { return z / (z0 + (1 - z0) * z); }

}  // namespace

std::vector<float> height_table(std::span<const HeightShare> shares, double uniform) {
  double weights = 0, upper = 0;
  for (const HeightShare& share : shares) {
    weights += share.weight;
    if (share.up) upper += share.weight;
  }
  const double even = weights > 0 ? uniform : 1, scale = weights > 0 ? (1 - uniform) / weights : 0;
  // This gives the share of directions above z, by its distance from the horizon.
  const auto above = [&](double z, bool up) {
    double sum = 0;
    for (const HeightShare& share : shares)
      if (share.up == up) sum += share.weight * below(share.z0, z);
    return up ? even * (1 - z) / 2 + scale * (upper - sum) : even * (1 + z) / 2 + scale * (upper + sum);
  };
  std::vector<double> z, share;
  double height = 1;
  for (int i = 0; i < grid_steps; ++i, height *= grid_ratio) z.push_back(height);
  z.push_back(0);
  for (const double up : z) share.push_back(above(up, true));
  for (int i = grid_steps - 1; i >= 0; --i) {
    share.push_back(above(z[i], false));
    z.push_back(-z[i]);
  }
  std::vector<float> out{1};
  size_t next = 1;
  for (uint32_t k = 1; k < WT_HEIGHT_CELLS; ++k) {
    const double wanted = static_cast<double>(k) / WT_HEIGHT_CELLS;
    while (next + 1 < share.size() && share[next] < wanted) ++next;
    const double wide = share[next] - share[next - 1];
    const double part = wide > 0 ? std::clamp((wanted - share[next - 1]) / wide, 0.0, 1.0) : 0;
    out.push_back(static_cast<float>(z[next - 1] + part * (z[next] - z[next - 1])));
  }
  out.push_back(-1);
  return out;
}

LaunchHeights::LaunchHeights(gpu::Context& context) : context_(context) {
  const HeightShare street[] = {{1, street_z0, true}, {1, street_z0, false}};
  set(height_table(street, street_uniform));
}

void LaunchHeights::set(const std::vector<float>& tables) {
  if (tables == values_) return;
  if (tables.size() > tables_.size())
    tables_ = context_.buffer(tables, "heights of launches");
  else
    tables_.write(tables);
  values_ = tables;
}

}  // namespace wavetracer
