// SPDX-License-Identifier: Apache-2.0
// Coherence of tracing results: between frames (equations 6.3 and 6.4 of the thesis) and inside one (equation 3.4). A.
// Zhdanov, TU Munich, 2014. Two corrections are made: points are paired by ray and bounce, and sums are normalised.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>
#include "study/statistics.hpp"

namespace wavetracer::study {

constexpr uint32_t nothing = 0xFFFFFFFFu;

// The end of a ray's segment. On a miss, surface and primitive are `nothing` and the rest is NaN.
struct Hit {
  glm::dvec3 point_m{undefined};
  double distance_m = undefined;  // from the hit before, or from the transmitter
  uint32_t surface = nothing, primitive = nothing;
};

inline bool is_hit(const Hit& hit) { return hit.surface != nothing; }

// hits[depth - 1][launch index]. Every depth has an entry for every ray, also for those that ended before.
using FrameHits = std::vector<std::vector<Hit>>;

// The correlation of the motions of points, a[i] with b[i].
struct PointCorrelation {
  glm::dvec3 component{undefined};  // Pearson's coefficients of x, of y and of z; NaN if one is undefined
  // Equation 6.4 with its normalisation: the root mean square of the defined components, so 0 to 1, and 1 for equal
  // clouds. It has no sign. NaN if no component is defined.
  double total = undefined;
  // The coefficient of the points as vectors: the sum of dot products of deviations over the root of the sums of their
  // squares; -1 to 1. Components are weighted by their variation. NaN if one of the clouds is a point.
  double pooled = undefined;
};

// A component that varies by resolution_m or less (standard deviation) counts as constant: float32 hit points of one
// wall are only equal to some 1e-5 m. Throws std::invalid_argument for lists of different lengths.
PointCorrelation correlate(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, double resolution_m = 1e-3);

// The coherence of the rays of two frames at one depth.
struct DepthCoherence {
  uint64_t pairs = 0;                // rays that hit in both frames
  uint64_t either = 0;               // rays that hit in at least one
  double both = undefined;           // pairs / either
  double same_surface = undefined;   // share of pairs that hit one surface
  double same_sequence = undefined;  // share of pairs whose surfaces agree up to this depth
  PointCorrelation points;           // correlation over the pairs
};

// Returns one entry per depth that both have. The frames must have launched the same rays: throws std::invalid_argument
// if their numbers differ.
std::vector<DepthCoherence> compare_frames(const FrameHits& a, const FrameHits& b);

// Returns the points that rays hit at one depth, by launch index, without misses.
std::vector<glm::dvec3> hit_points(std::span<const Hit> hits);

// The coherence of rays of one frame at one depth with those launched `lag` after them.
struct LagCoherence {
  uint32_t lag = 0;
  uint64_t pairs = 0;               // pairs that both hit
  double points = undefined;        // autocorrelation of hit points
  double distance = undefined;      // autocorrelation of the segments' lengths
  double same_surface = undefined;  // share of pairs
  double same_primitive = undefined;
};

// hits: in the order to be judged, including misses.
std::vector<LagCoherence> coherence_along(std::span<const Hit> hits, std::span<const uint32_t> lags);

}  // namespace wavetracer::study
