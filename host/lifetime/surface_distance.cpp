// SPDX-License-Identifier: Apache-2.0
// A walk through a tree of boxes: a box is entered if it may be nearer than what was found.
#include "lifetime/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "accel/triangles.hpp"

namespace wavetracer {
namespace {

// Boxes have corners in float32, which round by less than this share of a coordinate.
constexpr double box_rounding = 1e-7;

// Does the segment pass through the inside of the triangle?
bool meets(const Segment& s, const std::array<glm::dvec3, 3>& t) {
  const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double a = glm::dot(n, s.a - t[0]), b = glm::dot(n, s.b - t[0]);
  if (a == b || (a > 0) == (b > 0)) return false;
  const glm::dvec3 p = s.a + (a / (a - b)) * (s.b - s.a);
  for (int k = 0; k < 3; ++k)
    if (glm::dot(n, glm::cross(t[(k + 1) % 3] - t[k], p - t[k])) < 0) return false;
  return true;
}

// The distance from p to the triangle's plane, if the foot of p is inside of the triangle; else infinity.
double height_m(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
  const glm::dvec3 n = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = glm::length(n);
  if (!(length > 0)) return std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    if (glm::dot(n, glm::cross(t[(k + 1) % 3] - t[k], p - t[k])) < 0) return std::numeric_limits<double>::infinity();
  return std::abs(glm::dot(n, p - t[0])) / length;
}

// A distance that no point of the box is nearer to the segment than: the larger one of the gap between the segment's
// own box and this one, and of the distance to the sphere around this one.
double least_distance_m(const Segment& s, const Box& box) {
  double gap2 = 0, radius2 = 0, size = 0;
  glm::dvec3 centre;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = box.lower[axis], upper = box.upper[axis];
    const double gap = std::max({lower - std::max(s.a[axis], s.b[axis]), std::min(s.a[axis], s.b[axis]) - upper, 0.0});
    gap2 += gap * gap;
    radius2 += (upper - lower) * (upper - lower) / 4;
    centre[axis] = (lower + upper) / 2;
    size += std::max(std::abs(lower), std::abs(upper));
  }
  return std::max(std::sqrt(gap2), distance_m(centre, s) - std::sqrt(radius2)) - box_rounding * size;
}

}  // namespace

double distance_m(const glm::dvec3& p, const Segment& s) {
  const glm::dvec3 way = s.b - s.a;
  const double length2 = glm::dot(way, way);
  const double at = length2 > 0 ? std::clamp(glm::dot(p - s.a, way) / length2, 0.0, 1.0) : 0.0;
  return glm::distance(p, s.a + at * way);
}

// The least distance is that of two ends, or of an end and a point between the ends of the other, or of the feet of the
// common perpendicular, if both of its feet are on the segments.
double distance_m(const Segment& s, const Segment& o) {
  double least = std::min({distance_m(s.a, o), distance_m(s.b, o), distance_m(o.a, s), distance_m(o.b, s)});
  const glm::dvec3 u = s.b - s.a, v = o.b - o.a, w = s.a - o.a;
  const double a = glm::dot(u, u), b = glm::dot(u, v), c = glm::dot(v, v), d = glm::dot(u, w), e = glm::dot(v, w);
  const double det = a * c - b * b;
  if (!(det > 0)) return least;
  const double at_s = (b * e - c * d) / det, at_o = (a * e - b * d) / det;
  if (at_s < 0 || at_s > 1 || at_o < 0 || at_o > 1) return least;
  return std::min(least, glm::distance(s.a + at_s * u, o.a + at_o * v));
}

// The least distance is that of a side of the triangle, or of an end whose foot is inside of the triangle.
double distance_m(const Segment& s, const std::array<glm::dvec3, 3>& t) {
  if (meets(s, t)) return 0;
  double least = std::min(height_m(s.a, t), height_m(s.b, t));
  for (int k = 0; k < 3; ++k) least = std::min(least, distance_m(s, Segment{t[k], t[(k + 1) % 3]}));
  return least;
}

SurfaceDistance::SurfaceDistance(const Scene& scene) : scene_(scene) {
  const std::vector<AccelTriangle> triangles = accel_triangles(scene);
  if (!triangles.empty()) tree_ = build_binary(triangles, BuildOptions::for_bvh2());
}

std::array<glm::dvec3, 3> SurfaceDistance::corners(uint32_t triangle) const {
  const std::array<uint32_t, 3>& at = scene_.triangles[triangle];
  return {scene_.vertices[at[0]], scene_.vertices[at[1]], scene_.vertices[at[2]]};
}

double SurfaceDistance::operator()(const Segment& segment, double most_m,
                                   const std::function<bool(uint32_t)>& leaves_out) const {
  if (tree_.nodes.empty()) return most_m;
  struct Entry {
    uint32_t node;
    double least;
  };
  std::vector<Entry> stack{{0, least_distance_m(segment, tree_.nodes[0].box)}};
  double nearest = most_m;
  while (!stack.empty()) {
    const Entry entry = stack.back();
    stack.pop_back();
    if (entry.least >= nearest) continue;
    const BinaryNode& node = tree_.nodes[entry.node];
    if (node.left == 0) {
      for (uint32_t k = node.first; k < node.first + node.count; ++k) {
        const uint32_t triangle = tree_.references[k];
        if (!leaves_out(scene_.triangle_surface[triangle]))
          nearest = std::min(nearest, distance_m(segment, corners(triangle)));
      }
      continue;
    }
    Entry near{node.left, least_distance_m(segment, tree_.nodes[node.left].box)};
    Entry far{node.right, least_distance_m(segment, tree_.nodes[node.right].box)};
    if (far.least < near.least) std::swap(near, far);
    stack.push_back(far);
    stack.push_back(near);
  }
  return nearest;
}

}  // namespace wavetracer
