// SPDX-License-Identifier: Apache-2.0
// Sheets are found by joining surfaces; lines downwards find what lies below.
#include "scene/ground_rims.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;

constexpr double inset_m = 0.01;  // the line downwards starts on the face, this far beside the edge
constexpr double own_m = 0.02;    // a hit nearer than this is the sheet itself
constexpr int places = 8;         // number of places along the edge

bool open_below(const Wedge& wedge, const TriangleGrid& triangles) {
  const double bottom_m = triangles.bounds().lower.z - 1;
  for (int k = 0; k < places; ++k) {
    const dvec3 p = wedge.start + wedge.along * (wedge.length_m * (k + 0.5) / places) + wedge.face * inset_m;
    const auto below = triangles.crossings(p - dvec3(0, 0, own_m), {p.x, p.y, bottom_m});
    if (below.empty()) return true;
  }
  return false;
}

}  // namespace

GroundRims::GroundRims(const Scene& scene) : scene_(scene), sheets_(scene) {}

void GroundRims::join(uint32_t surface, uint32_t other) { sheets_.join(surface, other); }

bool GroundRims::are_of(const Wedge& wedge, const TriangleGrid& triangles) {
  if (wedge.surface[0] != wedge.surface[1]) return false;
  if (!is_flat(scene_.surfaces[wedge.surface[0]])) return false;
  if (wide_.empty()) wide_ = sheets_.wide();
  return wide_[sheets_.root(wedge.surface[0])] && open_below(wedge, triangles);
}

}  // namespace wavetracer
