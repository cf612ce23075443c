// SPDX-License-Identifier: Apache-2.0
// Boxes are swept along x: each is compared with those that have begun and not ended.
#include "scene/volume_overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "scene/scene_grid.hpp"
#include "scene/weld.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
using Corners = std::array<dvec3, 3>;

SceneBox box_of(const Volume& volume) {
  const double c = std::abs(std::cos(volume.yaw_rad)), s = std::abs(std::sin(volume.yaw_rad));
  const dvec3& h = volume.half_size;
  const dvec3 half(c * h.x + s * h.y, s * h.x + c * h.y, h.z);
  return {volume.centre - half, volume.centre + half};
}

bool meet(const SceneBox& a, const SceneBox& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::min(a.upper[axis], b.upper[axis]) - std::max(a.lower[axis], b.lower[axis]) <= weld_tolerance_m)
      return false;
  return true;
}

// Returns triangles and their corners in an order that does not depend on the file.
std::vector<Corners> in_order(const Volume& volume) {
  const auto before = [](const dvec3& a, const dvec3& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  };
  std::vector<Corners> out = volume.triangles;
  for (Corners& corners : out) std::ranges::sort(corners, before);
  std::ranges::sort(
      out, [&](const Corners& a, const Corners& b) { return std::ranges::lexicographical_compare(a, b, before); });
  return out;
}

bool same_turn(const Volume& a, const Volume& b) {
  const double reach_m = std::max(a.half_size.x, a.half_size.y);
  return std::abs(std::remainder(a.yaw_rad - b.yaw_rad, std::numbers::pi)) * reach_m <= weld_tolerance_m ||
         (a.shape != VolumeShape::box && std::abs(a.half_size.x - a.half_size.y) <= weld_tolerance_m);
}

bool same_volume(const Volume& a, const Volume& b) {
  if (a.shape != b.shape || glm::length(a.centre - b.centre) > weld_tolerance_m ||
      glm::length(a.half_size - b.half_size) > weld_tolerance_m)
    return false;
  if (a.shape != VolumeShape::mesh) return same_turn(a, b);
  return a.triangles.size() == b.triangles.size() && in_order(a) == in_order(b);
}

}  // namespace

std::vector<std::vector<uint32_t>> earlier_volumes(const std::vector<Volume>& volumes) {
  std::vector<SceneBox> boxes;
  for (const Volume& volume : volumes) boxes.push_back(box_of(volume));
  std::vector<uint32_t> order(volumes.size()), begun;
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](uint32_t i) { return boxes[i].lower.x; });
  std::vector<std::vector<uint32_t>> out(volumes.size());
  for (const uint32_t i : order) {
    std::erase_if(begun, [&](uint32_t j) { return boxes[j].upper.x <= boxes[i].lower.x; });
    for (const uint32_t j : begun)
      if (meet(boxes[i], boxes[j])) out[std::max(i, j)].push_back(std::min(i, j));
    begun.push_back(i);
  }
  for (std::vector<uint32_t>& list : out) std::ranges::sort(list);
  return out;
}

void settle_overlaps(std::vector<Volume>& volumes, std::vector<std::string>& warnings) {
  const std::vector<std::vector<uint32_t>> earlier = earlier_volumes(volumes);
  std::vector<Volume> kept;
  uint64_t repeated = 0, of_two_materials = 0;
  for (size_t i = 0; i < volumes.size(); ++i) {
    const bool again = std::ranges::any_of(earlier[i], [&](uint32_t j) { return same_volume(volumes[j], volumes[i]); });
    const bool of_others =
        std::ranges::any_of(earlier[i], [&](uint32_t j) { return volumes[j].material != volumes[i].material; });
    repeated += again;
    of_two_materials += of_others;
    if (!again) kept.push_back(volumes[i]);
  }
  if (repeated > 0)
    warnings.push_back(fmt::format("{} volumes of vegetation repeat another one; each was kept once", repeated));
  if (of_two_materials > 0)
    warnings.push_back(
        fmt::format("{} volumes of vegetation reach into the boxes of others of a different material; "
                    "space that both hold is that of the first ([[vegetation]] comes before meshes)",
                    of_two_materials));
  volumes = std::move(kept);
}

}  // namespace wavetracer
