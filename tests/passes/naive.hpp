// SPDX-License-Identifier: Apache-2.0
// The tracer of a first attempt, on the host: each numerical case of the tests must make it fail. It has float32
// Moeller-Trumbore with the usual epsilon, slabs by one fma, plain 1 / d, a short stack, and no tie rule.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "accel/layout.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer::test {

class NaiveTracer {
 public:
  explicit NaiveTracer(const Scene& scene, uint32_t max_leaf = 4) {
    const std::vector<AccelTriangle> triangles = accel_triangles(scene);
    BuildOptions options = BuildOptions::for_bvh2();
    options.max_leaf = max_leaf;
    bvh_ = make_bvh2(build_binary(triangles, options), triangles);
  }

  Hit operator()(const Ray& ray) const {
    Float3 inverse, offset;
    for (size_t axis = 0; axis < 3; ++axis) {
      inverse[axis] = 1.0f / ray.direction[axis];
      offset[axis] = -ray.origin[axis] * inverse[axis];
    }
    Hit hit;
    float nearest = std::numeric_limits<float>::infinity();
    int stack[stack_size], top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const int node = stack[--top];
      if (node < 0) {
        leaf(static_cast<uint32_t>(~node), ray, nearest, hit);
        continue;
      }
      const wt_bvh2_node& n = bvh_.nodes[static_cast<size_t>(node)];
      for (int side = 0; side < 2 && top < stack_size; ++side) {
        const wt_planes_xy& xy = side == 0 ? n.left : n.right;
        const float* box[] = {xy.x, xy.y, side == 0 ? n.left_z : n.right_z};
        if (enters(box, inverse, offset, nearest)) stack[top++] = n.child[side];
      }
    }
    return hit;
  }

  std::vector<Hit> operator()(const std::vector<Ray>& rays) const {
    std::vector<Hit> hits;
    for (const Ray& ray : rays) hits.push_back((*this)(ray));
    return hits;
  }

 private:
  static constexpr int stack_size = 16;
  Bvh2 bvh_;

  static bool enters(const float* const box[3], const Float3& inverse, const Float3& offset, float nearest) {
    float near = 0, far = nearest;
    for (size_t axis = 0; axis < 3; ++axis) {
      const float a = std::fma(box[axis][0], inverse[axis], offset[axis]);
      const float b = std::fma(box[axis][1], inverse[axis], offset[axis]);
      const float first = a < b ? a : b, last = a < b ? b : a;
      near = first > near ? first : near;
      far = last < far ? last : far;
    }
    return near <= far;
  }

  // T. Moeller and B. Trumbore, "Fast, minimum storage ray-triangle intersection", JGT 2(1), 1997.
  void leaf(uint32_t reference, const Ray& ray, float& nearest, Hit& hit) const {
    const uint32_t first = reference >> WT_LEAF_BITS, count = reference & ((1u << WT_LEAF_BITS) - 1);
    const auto cross = [](const Float3& a, const Float3& b) {
      return Float3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const Float3& a, const Float3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const auto minus = [](const Float3& a, const Float3& b) { return Float3{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
    for (uint32_t k = first; k < first + count; ++k) {
      // The copy for axis 2 holds the vertices unrotated.
      const wt_bvh2_triangle& t = bvh_.triangles[2 * size_t{bvh_.triangle_slots} + k];
      const auto corner = [](const wt_float4& v) { return Float3{v.s[0], v.s[1], v.s[2]}; };
      const Float3 a = corner(t.a), b = corner(t.b), c = corner(t.c);
      const Float3 ab = minus(b, a), ac = minus(c, a), p = cross(ray.direction, ac);
      const float determinant = dot(ab, p);
      if (std::abs(determinant) < 1e-8f) continue;
      const Float3 from = minus(ray.origin, a), q = cross(from, ab);
      const float u = dot(from, p) / determinant, v = dot(ray.direction, q) / determinant;
      const float distance = dot(ac, q) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || distance <= 0 || distance > nearest) continue;
      nearest = distance;
      hit = {distance, std::bit_cast<uint32_t>(t.a.s[3]), std::bit_cast<uint32_t>(t.b.s[3])};
    }
  }
};

}  // namespace wavetracer::test
