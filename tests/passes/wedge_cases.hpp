// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of the wedge passes: quads with wedges on the device, ends, and wedges read back. Sequences are
// listed, not traced; numbers of surfaces are those of the quads.
#pragma once
#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "passes/exact.hpp"
#include "passes/place.hpp"
#include "passes/triangles.hpp"
#include "passes/wedges.hpp"
#include "reference/planes.hpp"
#include "reference/quads.hpp"

namespace wavetracer::test {

using reference::Quad;

constexpr double every_wave_m = std::numeric_limits<double>::infinity();  // wavelength: no diffraction is too weak

inline glm::dvec3 vector_of(const double* v) { return {v[0], v[1], v[2]}; }

// As wt_wedge, but a Wedge of the scene.
inline Wedge wedge_of(const wt_wedge& w) {
  return {vector_of(w.start),
          vector_of(w.along),
          w.length,
          vector_of(w.face),
          vector_of(w.normal),
          w.exterior,
          {w.surfaces[0], w.surfaces[1]},
          {w.planes[0], w.planes[1]}};
}

// Tells whether p is in the free sector of the wedge, by angles, at least this far inside (or, if negative, at most
// this far outside).
inline bool in_sector(const Wedge& w, const glm::dvec3& p, double margin_rad = 0) {
  constexpr double turn = 2 * std::numbers::pi;
  const glm::dvec3 d = p - w.start;
  double azimuth = std::atan2(glm::dot(d, w.normal), glm::dot(d, w.face));
  if (azimuth < 0) azimuth += turn;
  if (w.exterior_rad > turn - 1e-9) return true;  // a half plane
  return (azimuth >= margin_rad && azimuth <= w.exterior_rad - margin_rad) || azimuth >= turn + margin_rad;
}

// Tells whether a mirror shows a point of a wedge, or may do so by rounding: lines from the image to many points of it.
inline bool shows(const wt_exact_surface& mirror, const wt_surface& box, const glm::dvec3& image, const Wedge& wedge,
                  double tolerance_m) {
  const glm::dvec3 normal = vector_of(mirror.normal);
  const double above = glm::dot(normal, image) - mirror.offset;
  for (int i = 0; i <= 1000; ++i) {
    const glm::dvec3 p = wedge.start + 0.001 * i * wedge.length_m * wedge.along;
    const double beyond = glm::dot(normal, p) - mirror.offset;
    if (above * beyond > tolerance_m) continue;
    const glm::dvec3 crossing = image + std::abs(above) / (std::abs(above) + std::abs(beyond)) * (p - image);
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
      inside &= crossing[axis] >= box.lower[axis] - tolerance_m && crossing[axis] <= box.upper[axis] + tolerance_m;
    if (inside) return true;
  }
  return false;
}

inline glm::dvec3 mirrored_by(const Surface& s, const glm::dvec3& p) {
  return p - 2 * (glm::dot(s.normal, p) - s.offset_m) * s.normal;
}

// A box, two panels whose edges are free, and a ground: surfaces 0 to 5, 6, 7, 8. 12 + 8 wedges.
inline std::vector<Quad> box_and_panel_quads() {
  std::vector<Quad> quads = reference::box_walls({-2, -3, 0.4}, {1.7, 2.4, 4.1});
  quads.push_back({{4.1, -2.2, 0.9}, {0.7, 4.3, 0.2}, {-0.3, 0.4, 3.1}});
  quads.push_back({{-3.3, 4.6, 1.2}, {4.2, 0.9, -0.4}, {0.5, 0.3, 2.9}});
  quads.push_back({{-30, -30, 0}, {60, 0, 0}, {0, 60, 0}});
  return quads;
}

inline Scene box_and_panels() {
  const std::vector<Quad> quads = box_and_panel_quads();
  Scene scene = reference::scene_of_quads(quads);
  scene.wedges = reference::box_wedges({-2, -3, 0.4}, {1.7, 2.4, 4.1});
  for (const uint32_t panel : {6u, 7u})
    for (const Wedge& w : reference::free_wedges(quads[panel], panel)) scene.wedges.push_back(w);
  return scene;
}

// Returns the sequence of a node of the trie or a root.
inline Sequence sequence_of(const std::vector<uint64_t>& table, uint32_t node) {
  Sequence s;
  for (; !(node & WT_ROOT); node = static_cast<uint32_t>(table[node] >> 32))
    s.surfaces.insert(s.surfaces.begin(), static_cast<uint32_t>(table[node]));
  s.transmitter = node & ~WT_ROOT;
  return s;
}

inline bool share_plane(const Wedge& v, const Wedge& w) {
  return v.plane[0] == w.plane[0] || v.plane[0] == w.plane[1] || v.plane[1] == w.plane[0] || v.plane[1] == w.plane[1];
}

// Tells whether a leg of the way from `end` over these points on these surfaces to p passes a surface for which
// blocks(surface) is true.
template <class Blocks>
bool obstructed(const Scene& scene, const glm::dvec3& end, const std::vector<glm::dvec3>& points,
                const std::vector<uint32_t>& surfaces, const glm::dvec3& p, const Blocks& blocks) {
  glm::dvec3 from = end;
  uint32_t left = reference::no_surface;
  for (size_t leg = 0; leg <= points.size(); ++leg) {
    const bool last = leg == points.size();
    const glm::dvec3 to = last ? p : points[leg];
    const uint32_t met = last ? reference::no_surface : surfaces[leg];
    const auto passed = reference::passages(scene, from, left, to, met);
    if (std::ranges::any_of(passed, [&](const reference::Passage& one) { return blocks(one.surface); })) return true;
    from = to;
    left = met;
  }
  return false;
}

}  // namespace wavetracer::test
