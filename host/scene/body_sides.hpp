// On which side of its plane a surface has the body that it bounds.
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
  // Assumes a scene with its surfaces, and triangle_edges as find_edges() returns them; both must outlive this.
  BodySides(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges)
      : scene_(scene), triangle_edges_(triangle_edges), known_(scene.surfaces.size()) {}

  // +1: on the side of the surface's normal, -1: on the other one; 0: the surface is open or bounds bodies on both
  // sides. A surface has a body behind it where other faces meet it all along its border, those of its own mesh before
  // others, all of them on one side: a wall of a house has, and a sheet of ground or a door drawn on a wall has not.
  int side(uint32_t surface);

  // Can nobody see a place where these two surfaces lie on each other? That is where they are between two bodies, as
  // the wall between touching houses, or where a body stands on a sheet, as a house on the ground.
  bool hidden_between(uint32_t surface, uint32_t other);

 private:
  int find_side(uint32_t surface) const;

  const Scene& scene_;
  std::span<const std::array<uint32_t, 3>> triangle_edges_;
  std::vector<std::optional<int>> known_;
};

}  // namespace wavetracer
