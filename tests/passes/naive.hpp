// The tracer that a first attempt would write, on the host: what each numerical case of the tests must make fail.
// Float32 Moeller-Trumbore with the usual epsilon, slabs by one fma, 1 / d as it comes, a short stack, no tie rule.
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
      const float* n = &bvh_.nodes[static_cast<size_t>(node) * WT_BVH2_NODE_FLOATS];
      for (int side = 0; side < 2 && top < stack_size; ++side) {
        const float* box[] = {n + 4 * side, n + 4 * side + 2, n + 8 + 2 * side};
        if (enters(box, inverse, offset, nearest)) stack[top++] = std::bit_cast<int>(n[12 + side]);
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
      const float* t = &bvh_.triangles[12 * (2 * size_t{bvh_.triangle_slots} + k)];
      const Float3 a{t[0], t[1], t[2]}, b{t[4], t[5], t[6]}, c{t[8], t[9], t[10]};
      const Float3 ab = minus(b, a), ac = minus(c, a), p = cross(ray.direction, ac);
      const float determinant = dot(ab, p);
      if (std::abs(determinant) < 1e-8f) continue;
      const Float3 from = minus(ray.origin, a), q = cross(from, ab);
      const float u = dot(from, p) / determinant, v = dot(ray.direction, q) / determinant;
      const float distance = dot(ac, q) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || distance <= 0 || distance > nearest) continue;
      nearest = distance;
      hit = {distance, std::bit_cast<uint32_t>(t[3]), std::bit_cast<uint32_t>(t[7])};
    }
  }
};

}  // namespace wavetracer::test
