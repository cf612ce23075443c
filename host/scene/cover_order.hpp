// SPDX-License-Identifier: Apache-2.0
// Decides which of two surfaces of one plane covers the other: the smaller one does, such as a road drawn on the ground
// or a door drawn on a wall. If their areas agree in six digits, it is the one whose material comes first in the
// alphabet. A surface that covers another one takes its plane, if they differ by rounding alone.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

class CoverOrder {
 public:
  // Surfaces of one material and plane that continue each other beyond T-junctions count as one: a ground of tiles is
  // as large as all its tiles together. The scene's surfaces must be known, and the scene must outlive this object;
  // triangle_edges: as find_edges() returns them.
  CoverOrder(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges);

  // Tells whether a surface covers another one of another material. Exactly one of two surfaces covers the other,
  // whatever their order in the file.
  bool covers(uint32_t surface, uint32_t other) const { return key(surface) < key(other); }
  bool equally_large(uint32_t surface, uint32_t other) const { return area_m2_[surface] == area_m2_[other]; }

 private:
  std::pair<double, std::string_view> key(uint32_t surface) const;

  const Scene& scene_;
  std::vector<double> area_m2_;  // area of each surface and those that continue it, in six digits
};

// Gives a surface that covers others the plane of the largest of them, if that plane is within 0.1 mm of all its
// corners and differs from its own by more than rounding in double. So a door drawn on a wall mirrors as the wall does,
// and the border between them is no bend at which waves diffract. No vertex is moved. pairs: triangles, the covered one
// first.
void share_planes(Scene& scene, const CoverOrder& order, std::span<const std::pair<uint32_t, uint32_t>> pairs);

}  // namespace wavetracer
