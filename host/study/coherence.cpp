// SPDX-License-Identifier: Apache-2.0
// Pairs by launch index and depth, then computes statistics of the pairs.
// Sums are of differences of points, so that places far from the origin lose no digits.
#include "study/coherence.hpp"
#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

namespace wavetracer::study {
namespace {

double share(uint64_t part, uint64_t whole) {
  return whole == 0 ? undefined : static_cast<double>(part) / static_cast<double>(whole);
}

std::vector<double> components(std::span<const glm::dvec3> points, int axis) {
  std::vector<double> out;
  out.reserve(points.size());
  for (const glm::dvec3& point : points) out.push_back(point[axis]);
  return out;
}

glm::dvec3 centroid(std::span<const glm::dvec3> points) {
  glm::dvec3 sum{0};
  for (const glm::dvec3& point : points) sum += point - points.front();
  return points.front() + sum / static_cast<double>(points.size());
}

void check_lengths(size_t a, size_t b, const char* who) {
  if (a != b) throw std::invalid_argument(std::string(who) + ": lists of different lengths");
}

double pooled(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, double resolution_m) {
  if (a.size() < 2) return undefined;
  const glm::dvec3 centre_a = centroid(a), centre_b = centroid(b);
  double aa = 0, bb = 0, ab = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const glm::dvec3 da = a[i] - centre_a, db = b[i] - centre_b;
    aa += glm::dot(da, da);
    bb += glm::dot(db, db);
    ab += glm::dot(da, db);
  }
  const double constant = resolution_m * resolution_m * static_cast<double>(a.size());
  return aa <= constant || bb <= constant ? undefined : ab / (std::sqrt(aa) * std::sqrt(bb));
}

}  // namespace

PointCorrelation correlate(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, double resolution_m) {
  check_lengths(a.size(), b.size(), "correlate");
  PointCorrelation out;
  double squares = 0;
  int defined = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double r = out.component[axis] = pearson(components(a, axis), components(b, axis), resolution_m);
    if (std::isnan(r)) continue;
    squares += r * r;
    ++defined;
  }
  if (defined > 0) out.total = std::sqrt(squares / defined);
  out.pooled = pooled(a, b, resolution_m);
  return out;
}

std::vector<DepthCoherence> compare_frames(const FrameHits& a, const FrameHits& b) {
  std::vector<DepthCoherence> out(std::min(a.size(), b.size()));
  if (out.empty()) return out;
  std::vector<bool> agreed(a.front().size(), true);  // rays whose surfaces were the same so far
  for (size_t depth = 0; depth < out.size(); ++depth) {
    for (const FrameHits* frame : {&a, &b}) check_lengths((*frame)[depth].size(), agreed.size(), "compare_frames");
    DepthCoherence& at = out[depth];
    uint64_t same_surface = 0, same_sequence = 0;
    std::vector<glm::dvec3> points_a, points_b;
    for (size_t ray = 0; ray < agreed.size(); ++ray) {
      const Hit &hit_a = a[depth][ray], &hit_b = b[depth][ray];
      const bool same = hit_a.surface == hit_b.surface;
      agreed[ray] = agreed[ray] && same;
      at.either += is_hit(hit_a) || is_hit(hit_b);
      if (!is_hit(hit_a) || !is_hit(hit_b)) continue;
      points_a.push_back(hit_a.point_m);
      points_b.push_back(hit_b.point_m);
      same_surface += same;
      same_sequence += agreed[ray];
    }
    at.pairs = points_a.size();
    at.both = share(at.pairs, at.either);
    at.same_surface = share(same_surface, at.pairs);
    at.same_sequence = share(same_sequence, at.pairs);
    at.points = correlate(points_a, points_b);
  }
  return out;
}

std::vector<glm::dvec3> hit_points(std::span<const Hit> hits) {
  std::vector<glm::dvec3> out;
  for (const Hit& hit : hits)
    if (is_hit(hit)) out.push_back(hit.point_m);
  return out;
}

std::vector<LagCoherence> coherence_along(std::span<const Hit> hits, std::span<const uint32_t> lags) {
  std::vector<glm::dvec3> points;
  std::vector<double> distances;
  for (const Hit& hit : hits) {
    points.push_back(hit.point_m);
    distances.push_back(hit.distance_m);
  }
  const std::vector<double> of_points = autocorrelation(points, lags), of_distance = autocorrelation(distances, lags);
  std::vector<LagCoherence> out;
  for (size_t k = 0; k < lags.size(); ++k) {
    LagCoherence at{.lag = lags[k], .points = of_points[k], .distance = of_distance[k]};
    uint64_t same_surface = 0, same_primitive = 0;
    for (size_t i = 0; i + lags[k] < hits.size(); ++i) {
      const Hit &a = hits[i], &b = hits[i + lags[k]];
      if (!is_hit(a) || !is_hit(b)) continue;
      ++at.pairs;
      same_surface += a.surface == b.surface;
      same_primitive += a.primitive == b.primitive;
    }
    at.same_surface = share(same_surface, at.pairs);
    at.same_primitive = share(same_primitive, at.pairs);
    out.push_back(at);
  }
  return out;
}

}  // namespace wavetracer::study
