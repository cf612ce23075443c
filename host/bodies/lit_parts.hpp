// SPDX-License-Identifier: Apache-2.0
// Finds the parts of facets of a body that a source sees, directly or by mirrors of the body itself: exact polygons.
#pragma once
#include <cstdint>
#include <vector>

#include "bodies/facet_tree.hpp"
#include "bodies/polygons.hpp"

namespace wavetracer {

// A facet, ready for questions of visibility, with a sphere about it.
struct SeenFacet {
  Plane plane;
  Sphere sphere;
};

// Waves that spread from one point: a source, or its image in the last of the facets that reflected them, which they
// leave through the lit part of that facet.
struct Beam {
  glm::dvec3 source;
  std::vector<uint32_t> mirrors;  // facets, in the order in which they reflect
  // All points that the beam lights are above these planes: the sides of the pyramid through the lit part of the last
  // mirror, and, as the last one, that mirror. There are none without mirrors.
  std::vector<Plane> bounds;
};

// Keeps a reference to the body. A tree of spheres finds the few facets that may hide one.
class LitParts {
 public:
  explicit LitParts(const Body& body);

  // The convex parts of the facet that the beam lights, in no order. Parts that are narrower than the tolerance, 1e-9
  // of the body's size, are left out.
  std::vector<Polygon> operator()(const Beam& beam, uint32_t facet) const;
  // Returns the beam that a lit part of this facet reflects.
  Beam reflected(const Beam& beam, uint32_t facet, const Polygon& part) const;
  // The facet's plane, with the source on its upper side.
  Plane towards(glm::dvec3 source, uint32_t facet) const;
  double size_m() const { return size_m_; }

 private:
  bool may_light(const Beam& beam, uint32_t facet) const;
  bool lit_side(const Beam& beam, uint32_t facet) const;
  // The facets that may hide this one from the beam, in ascending order.
  std::vector<uint32_t> hiders(const Beam& beam, uint32_t facet) const;

  const Body& body_;
  bool closed_;
  double size_m_ = 0, tolerance_m_ = 0;
  std::vector<SeenFacet> facets_;
  FacetTree tree_;
};

}  // namespace wavetracer
