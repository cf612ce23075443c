// SPDX-License-Identifier: Apache-2.0
// Plots sampled rays (waypoints.h5) of one frame from above: their segments, and the centroid of their hits at each
// segment.
#pragma once
#include <array>
#include <string>
#include <vector>
#include "plots/figure.hpp"
#include "wavetracer/ray_waypoints.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::plots {

constexpr size_t most_segments = 20000;  // a drawing with more becomes too slow in a browser

// A segment from a point of a ray to the next; file coordinates, in metres.
struct RaySegment {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  uint32_t number = 0;  // number of the segment in its ray, from 1
  WaypointSource source = WaypointSource::unknown;
};

// Returns segments of every `step`-th ray; receivers that a ray passes are not points of it, and the metre behind a
// miss is left out.
std::vector<RaySegment> ray_segments(const WaypointRows& rows, size_t step);

// The centroid of the hits of all segments with this number.
struct RayCentroid {
  uint32_t number = 0;
  size_t hits = 0, answered = 0;  // answered: by the ray cache
  glm::dvec3 position_m{0};
};
std::vector<RayCentroid> ray_centroids(const WaypointRows& rows);

// when: ", 0.5 s" or empty. There must be a segment. Walls are cut at the height of the first launch.
Figure rays_figure(const WaypointRows& rows, const std::string& when, const Scene& scene);

}  // namespace wavetracer::plots
