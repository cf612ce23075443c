// SPDX-License-Identifier: Apache-2.0
// Tells on which side of its plane a surface has the body that it bounds.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

class BodySides {
 public:
  // Assumes a scene whose surfaces are set, and triangle_edges as find_edges() returns them; both must outlive this
  // object.
  BodySides(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges)
      : scene_(scene), triangle_edges_(triangle_edges), known_(scene.surfaces.size()) {}

  // Returns +1 if the body is on the side of the surface's normal, -1 if it is on the other side, 0 if the surface is
  // open or bounds bodies on both sides. A surface has a body behind it if other faces meet it along its whole border,
  // all on the same side (faces of its own mesh count before others): a wall of a house has one; a sheet of ground, or
  // a door drawn on a wall, has not.
  int side(uint32_t surface);

  // Tells whether places where these two surfaces lie on each other are invisible. They are if they lie between two
  // bodies (the wall between touching houses) or under a body that stands on a sheet (a house on the ground).
  bool hidden_between(uint32_t surface, uint32_t other);

 private:
  int find_side(uint32_t surface) const;

  const Scene& scene_;
  std::span<const std::array<uint32_t, 3>> triangle_edges_;
  std::vector<std::optional<int>> known_;
};

}  // namespace wavetracer
