// SPDX-License-Identifier: Apache-2.0
// Finds which surfaces make up one plane: those of a roof in pieces that are not welded, of two materials, or of
// several houses. A wave between two edges of that plane runs along it, whichever of its surfaces it ends on.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/forest.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Two surfaces belong together on one of their sides if they lie in one plane and touch with nothing between them on
// that side, directly or through other surfaces. So roofs of equal height on both sides of a street do not belong
// together; nor, on the upper side, do the two parts of a roof that a wall divides. Two surfaces lie in one plane if
// their planes are the same (same_plane of host/scene/topology.hpp), or if they are bent by less than 1 mrad and all
// corners of each are within 0.2 mm of the other's plane, so that rounding the corners of walls changes nothing. A row
// of surfaces, each bent a little against the one before, may be a curve, so the path between two edges of it is tested
// as well (wt_share_plane of kernels/lib/wedge.clh).
class FacePlanes {
 public:
  // Joins surfaces that share flat edges of the mesh; the scene must outlive this object.
  explicit FacePlanes(const Scene& scene);
  // Joins two surfaces that touch at a point and are bent there by less than 1 mrad, on the side that `front` points
  // to, if they lie in one plane.
  void join(uint32_t surface, uint32_t other, const glm::dvec3& front, const glm::dvec3& at);
  // Fills Wedge::plane.
  void number(std::span<Wedge> wedges);

 private:
  bool in_one_plane(uint32_t surface, uint32_t other, const glm::dvec3& at);
  uint32_t side(uint32_t surface, const glm::dvec3& front) const;  // node of the forest

  const Scene& scene_;
  std::set<std::pair<uint32_t, uint32_t>> apart_;  // pairs that are bent by too much
  Forest sides_;                                   // nodes: 2 surface, plus 1 for the side behind its normal
};

}  // namespace wavetracer
