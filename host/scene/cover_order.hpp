// Which of two surfaces of one plane covers the other: the smaller one, as a road drawn on the ground or a door drawn
// on a wall; of two whose areas agree in six digits the one whose material comes first in the alphabet.
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
  // Surfaces of one material and plane that go on beyond T-junctions count as one: a ground of tiles is as large as all
  // of them together. Assumes a scene whose surfaces are known and which outlives this; triangle_edges as
  // find_edges() returns them.
  CoverOrder(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges);

  // Does a surface cover another one of another material? Of two, exactly one does; the order of the file is no matter.
  bool covers(uint32_t surface, uint32_t other) const { return key(surface) < key(other); }
  bool equally_large(uint32_t surface, uint32_t other) const { return area_m2_[surface] == area_m2_[other]; }

 private:
  std::pair<double, std::string_view> key(uint32_t surface) const;

  const Scene& scene_;
  std::vector<double> area_m2_;  // of each surface, with what continues it, in six digits
};

}  // namespace wavetracer
