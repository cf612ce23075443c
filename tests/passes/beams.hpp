// SPDX-License-Identifier: Apache-2.0
// Worlds of loose triangles for the passes of beams: what an end sees through the faces of a cube and, mirror by
// mirror, deeper; and the same by single rays in double, each of which is tested against all triangles.
#pragma once
#include <doctest/doctest.h>

#include <limits>
#include <set>

#include "passes/beam_gather.hpp"
#include "passes/beam_visible.hpp"
#include "passes/sequences.hpp"
#include "passes/triangles.hpp"
#include "simulation/beam_tracing.hpp"

namespace wavetracer::test {

using Surfaces = std::vector<uint32_t>;

// A window in the plane x = 1, which has these bounds and is a root, seen from the origin.
inline wt_aperture window(double low_y, double high_y, double low_z, double high_z) {
  wt_aperture out{};
  const double corners[12] = {1, low_y, low_z, 1, high_y, low_z, 1, high_y, high_z, 1, low_y, high_z};
  std::ranges::copy(corners, out.corners);
  out.count = 4;
  out.node = WT_ROOT;
  out.surface = out.own = WT_NONE;
  return out;
}

// The surfaces that a ray meets one after the other, at most max_depth of them.
inline Surfaces met(const std::vector<Corners>& triangles, glm::dvec3 from, glm::dvec3 direction, size_t max_depth) {
  Surfaces out;
  while (out.size() < max_depth) {
    double nearest = std::numeric_limits<double>::infinity();
    uint32_t surface = WT_NONE;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
      if (!out.empty() && out.back() == t) continue;
      const Corners& c = triangles[t];
      const glm::dvec3 u = c[1] - c[0], v = c[2] - c[0], p = glm::cross(direction, v), s = from - c[0],
                       q = glm::cross(s, u);
      const double below = glm::dot(u, p), a = glm::dot(s, p) / below, b = glm::dot(direction, q) / below,
                   distance = glm::dot(v, q) / below;
      if (a < 0 || b < 0 || a + b > 1 || !(distance > 0) || distance >= nearest) continue;
      nearest = distance;
      surface = t;
    }
    if (surface == WT_NONE) break;
    out.push_back(surface);
    from += nearest * direction;
    const Corners& c = triangles[surface];
    const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    direction -= 2 * glm::dot(direction, normal) * normal;
  }
  return out;
}

// The sequences that `count` rays in random directions meet, with all their beginnings.
inline std::set<Surfaces> met_by_rays(const std::vector<Corners>& triangles, const glm::dvec3& from, size_t max_depth,
                                      uint32_t count, uint32_t seed) {
  Random random(seed);
  std::set<Surfaces> out;
  for (uint32_t i = 0; i < count; ++i)
    for (Surfaces all = met(triangles, from, random.direction(), max_depth); !all.empty(); all.pop_back())
      out.insert(all);
  return out;
}

// The sequences that beams find, by the whole loop over depths. No surface is opaque: max_transmissions of them may be
// passed.
struct SeenByBeams {
  std::set<Surfaces> sequences;
  BeamCounts counts;
};

inline SeenByBeams seen_by_beams(const std::vector<Corners>& triangles, const glm::dvec3& from, uint32_t max_depth,
                                 size_t slots = 1 << 16, uint32_t max_transmissions = 0) {
  const Scene scene = scene_of_triangles(triangles);
  const DeviceScene device = make_device_scene(context(), scene, false);
  BeamTracing beams(context(), scene, {},
                    {.max_transmissions = max_transmissions, .mirrors = lossless_mirrors(triangles.size())});
  beams.set_world({}, {});
  Sequences set(context(), slots);
  set.clear();
  SeenByBeams out;
  out.counts = beams.find(
      device, {.standing = {{.transmitter = 0, .position_m = from}}, .moving = {}, .max_depth = max_depth}, set);
  const std::vector<uint64_t> table = set.table().read();
  for (uint64_t word : table) {
    if (word == WT_EMPTY) continue;
    Surfaces surfaces{static_cast<uint32_t>(word)};
    for (auto parent = static_cast<uint32_t>(word >> 32); !(parent & WT_ROOT);
         parent = static_cast<uint32_t>(word >> 32)) {
      word = table[parent];
      surfaces.push_back(static_cast<uint32_t>(word));
    }
    std::ranges::reverse(surfaces);
    out.sequences.insert(surfaces);
  }
  return out;
}

inline std::vector<Corners> loose_triangles(uint32_t count, double size, uint32_t seed) {
  Random random(seed);
  std::vector<Corners> out;
  while (out.size() < count) {
    const glm::dvec3 at = random.in_cube(8);
    const Corners c{at, at + size * random.direction(), at + size * random.direction()};
    if (glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) > 0.05 * size * size) out.push_back(c);
  }
  return out;
}

}  // namespace wavetracer::test
