// SPDX-License-Identifier: Apache-2.0
#include "bodies/lit_parts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace wavetracer {
namespace {

Polygon above_all(Polygon polygon, const std::vector<Plane>& planes, double tolerance_m) {
  for (const Plane& plane : planes) {
    if (polygon.empty()) break;
    polygon = part_above(polygon, plane, tolerance_m);
  }
  return polygon;
}

SeenFacet seen_facet(const Polygon& corners) {
  SeenFacet seen{plane_of(corners), {centroid(corners), 0}};
  double& radius_m = seen.sphere.radius_m;
  for (const glm::dvec3 p : corners) radius_m = std::max(radius_m, glm::length(p - seen.sphere.centre));
  return seen;
}

// Cones about both spheres: false if they have no direction from the source in common, or the nearer one is behind. It
// may be true for nothing.
bool may_hide(const glm::dvec3& source, const Sphere& near, const Sphere& far) {
  const glm::dvec3 to_near = near.centre - source, to_far = far.centre - source;
  const double near_m = glm::length(to_near), far_m = glm::length(to_far);
  if (near_m - near.radius_m > far_m + far.radius_m) return false;
  if (near_m <= near.radius_m || far_m <= far.radius_m) return true;
  // Angles are those of sines, and the distance between both lines of sight is at least that of the nearer sphere.
  const double angle = std::asin(near.radius_m / near_m) + std::asin(far.radius_m / far_m);
  const double between = std::atan2(glm::length(glm::cross(to_near, to_far)), glm::dot(to_near, to_far));
  return between <= angle * (1 + 1e-9) + 1e-12;
}

// False if the sphere is on the dark side of one of the beam's bounds.
bool reaches(const Beam& beam, const Sphere& sphere, double tolerance_m) {
  return std::ranges::all_of(beam.bounds, [&](const Plane& bound) {
    return height_over(bound, sphere.centre) >= -sphere.radius_m - tolerance_m;
  });
}

}  // namespace

LitParts::LitParts(const Body& body) : body_(body), closed_(is_closed(body)) {
  glm::dvec3 lower(INFINITY), upper(-INFINITY);
  for (const Facet& facet : body.facets) {
    facets_.push_back(seen_facet(facet.corners));
    for (const glm::dvec3 p : facet.corners) {
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
  }
  size_m_ = glm::length(upper - lower);
  tolerance_m_ = 1e-9 * size_m_;
  std::vector<Sphere> spheres;
  for (const SeenFacet& seen : facets_) spheres.push_back(seen.sphere);
  tree_ = FacetTree(spheres);
}

Plane LitParts::towards(glm::dvec3 source, uint32_t facet) const {
  const Plane& plane = facets_[facet].plane;
  return height_over(plane, source) < 0 ? flipped(plane) : plane;
}

// A closed body is lit from outside alone; a source in the plane of a facet does not light it.
bool LitParts::lit_side(const Beam& beam, uint32_t facet) const {
  const double height = height_over(facets_[facet].plane, beam.source);
  return closed_ ? height > tolerance_m_ : std::abs(height) > tolerance_m_;
}

// False if the facet is on the dark side of one of the beam's bounds.
bool LitParts::may_light(const Beam& beam, uint32_t facet) const {
  if (!lit_side(beam, facet) || (!beam.mirrors.empty() && beam.mirrors.back() == facet)) return false;
  return reaches(beam, facets_[facet].sphere, tolerance_m_);
}

std::vector<uint32_t> LitParts::hiders(const Beam& beam, uint32_t facet) const {
  std::vector<uint32_t> out;
  const Sphere& far = facets_[facet].sphere;
  const auto may = [&](const Sphere& sphere) {
    return reaches(beam, sphere, tolerance_m_) && may_hide(beam.source, sphere, far);
  };
  tree_.visit(may, [&](uint32_t blocker) {
    if (blocker != facet && may_light(beam, blocker) && may_hide(beam.source, facets_[blocker].sphere, far))
      out.push_back(blocker);
  });
  std::ranges::sort(out);
  return out;
}

std::vector<Polygon> LitParts::operator()(const Beam& beam, uint32_t facet) const {
  if (!may_light(beam, facet)) return {};
  Polygon reached = above_all(body_.facets[facet].corners, beam.bounds, tolerance_m_);
  if (reached.empty()) return {};
  std::vector<Polygon> lit{std::move(reached)};
  const Plane side = towards(beam.source, facet);
  for (const uint32_t blocker : hiders(beam, facet)) {
    if (lit.empty()) break;
    Polygon between = part_above(body_.facets[blocker].corners, side, tolerance_m_);
    if (!between.empty() && !beam.bounds.empty()) between = part_above(between, beam.bounds.back(), tolerance_m_);
    if (!between.empty()) subtract(lit, pyramid(beam.source, between, tolerance_m_), tolerance_m_);
  }
  return lit;
}

Beam LitParts::reflected(const Beam& beam, uint32_t facet, const Polygon& part) const {
  const Plane& plane = facets_[facet].plane;
  Beam out{beam.source - plane.normal * (2 * height_over(plane, beam.source)), beam.mirrors, {}};
  out.mirrors.push_back(facet);
  out.bounds = pyramid(out.source, part, tolerance_m_);
  out.bounds.push_back(towards(beam.source, facet));
  return out;
}

}  // namespace wavetracer
