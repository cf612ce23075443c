// SPDX-License-Identifier: Apache-2.0
// Writes points of rays, column by column.
// A ray is one sample of one transmitter: its rows follow each other, sorted by depth.
#include "viewer/ray_blocks.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "viewer/blocks.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t bytes_per_point = 15;  // a third more in base64

// Returns the points of each `step`-th ray, without the receivers that it passes.
std::vector<size_t> shown_points(const WaypointRows& rows, uint64_t step) {
  std::vector<size_t> out;
  uint64_t ray = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && (rows.tx[i] != rows.tx[i - 1] || rows.sample[i] != rows.sample[i - 1])) ++ray;
    if (ray % step == 0 && rows.kind[i] != WaypointKind::hit) out.push_back(i);
  }
  return out;
}

}  // namespace

RayBlocks add_ray_blocks(const SavedWaypoints& waypoints, const std::vector<uint32_t>& frames,
                         const glm::dvec3& centre_m, uint64_t bytes, std::string& elements) {
  const uint64_t most = std::max<uint64_t>(bytes * 3 / 4 / bytes_per_point, 1);
  uint64_t rows_of_all = 0;
  for (const uint32_t number : frames) rows_of_all += waypoints.count(number);
  const uint64_t step = std::max<uint64_t>((rows_of_all + most - 1) / most, 1);
  RayBlocks out;
  if (step > 1)
    out.warning =
        fmt::format("the page holds one of every {} sampled rays; fewer frames (--frames) show more of them", step);
  for (size_t row = 0; row < frames.size(); ++row) {
    const WaypointRows rows = waypoints.frame(frames[row]);
    const std::vector<size_t> points = shown_points(rows, step);
    Packer block;
    for (const size_t i : points) block.add(rows.position_m[i] - centre_m);
    for (const size_t i : points) {
      block.add(static_cast<uint8_t>(std::min(rows.depth[i], 255u)));
      out.highest_depth = std::max(out.highest_depth, rows.depth[i]);
    }
    for (const size_t i : points) {
      block.add(static_cast<uint8_t>(rows.source[i]));
      out.sources = out.sources || rows.source[i] == WaypointSource::traced || rows.source[i] == WaypointSource::cache;
    }
    for (const size_t i : points) block.add(static_cast<uint8_t>(rows.kind[i]));
    out.frames.push_back(points.size());
    elements += block_element(fmt::format("rays_{}", row), block);
  }
  return out;
}

}  // namespace wavetracer
