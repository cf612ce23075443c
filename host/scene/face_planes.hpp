// Says which surfaces make up one plane: those of a roof in pieces that are not welded, of two materials, or of several
// houses. A wave between two edges of that plane runs along it, whatever number the surface has on which it ends.
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

// Surfaces belong together, on one of their sides, if they lie in one plane and touch each other there with nothing
// between them on that side, directly or by way of others. So roofs of one height on both sides of a street do not,
// nor, above the roof, the two parts that a wall on it divides. Two surfaces lie in one plane if their planes are the
// same (same_plane of host/scene/topology.hpp), or if they are bent by less than 1 mrad and all corners of each are
// within 0.2 mm of the plane of the other: so walls whose corners were rounded are what they were. A row of surfaces
// that bend one after the other may be a curve, so the way between two edges of it is asked as well (wt_share_plane of
// kernels/lib/wedge.clh).
class FacePlanes {
 public:
  explicit FacePlanes(const Scene& scene);  // joins surfaces that share flat edges of the mesh; scene outlives this
  // Joins two surfaces that touch at a point and are bent there by less than 1 mrad, on the side that `front` points
  // to, if they lie in one plane.
  void join(uint32_t surface, uint32_t other, const glm::dvec3& front, const glm::dvec3& at);
  // Fills Wedge::plane.
  void number(std::span<Wedge> wedges);

 private:
  bool in_one_plane(uint32_t surface, uint32_t other, const glm::dvec3& at);
  uint32_t side(uint32_t surface, const glm::dvec3& front) const;  // of the forest

  const Scene& scene_;
  std::set<std::pair<uint32_t, uint32_t>> apart_;  // bent by too much
  Forest sides_;                                   // of 2 surface, + 1 behind its normal
};

}  // namespace wavetracer
