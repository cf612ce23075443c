// SPDX-License-Identifier: Apache-2.0
// Tracing of the oracle. The intersection is S. Woop, C. Benthin, I. Wald: Watertight Ray/Triangle Intersection, JCGT
// 2013, in double, where float32 vertices make its edge functions nearly exact.
#include "oracle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "wavetracer/device/bvh.h"

namespace wavetracer::test {
namespace {

using Vertices = std::array<std::array<double, 3>, 3>;  // [vertex][axis]

struct Shear {
  size_t kz, kx, ky;
  double sx, sy, sz;
  explicit Shear(const OracleRay& ray) {
    const auto size = [&](size_t axis) { return std::abs(ray.direction[axis]); };
    kz = size(0) > size(1) ? (size(0) > size(2) ? 0 : 2) : (size(1) > size(2) ? 1 : 2);
    kx = (kz + 1) % 3;
    ky = (kz + 2) % 3;
    sz = 1 / ray.direction[kz];
    sx = ray.direction[kx] * sz;
    sy = ray.direction[ky] * sz;
  }
};

void intersect(const OracleRay& ray, const Shear& s, const Vertices& v, uint32_t primitive, OracleHit& hit) {
  std::array<double, 3> x, y, z;
  for (size_t i = 0; i < 3; i++) {
    z[i] = v[i][s.kz] - ray.origin[s.kz];
    x[i] = (v[i][s.kx] - ray.origin[s.kx]) - s.sx * z[i];
    y[i] = (v[i][s.ky] - ray.origin[s.ky]) - s.sy * z[i];
  }
  const double a = x[2] * y[1] - y[2] * x[1], b = x[0] * y[2] - y[0] * x[2], c = x[1] * y[0] - y[1] * x[0];
  if ((a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0)) return;
  const double sum = a + b + c;
  if (sum == 0) return;
  const double t = s.sz * (a * z[0] + b * z[1] + c * z[2]) / sum;
  if (t > 0 && (t < hit.t || (t == hit.t && primitive < hit.primitive))) hit = {t, primitive};
}

// Boxes are widened by the rounding of doubles, far less than float32 resolves: a missing ulp of a box would still be
// seen.
bool enters(const OracleRay& ray, const Box& box, double t_max) {
  double near = 0, far = t_max, size = 0;
  if (box.empty()) return false;
  for (size_t axis = 0; axis < 3; axis++)
    for (const double x : {double{box.lower[axis]}, double{box.upper[axis]}, ray.origin[axis]})
      size = std::max(size, std::abs(x));
  const double pad = 1e-13 * size;
  for (size_t axis = 0; axis < 3; axis++) {
    const double lower = box.lower[axis] - ray.origin[axis] - pad, upper = box.upper[axis] - ray.origin[axis] + pad;
    if (ray.direction[axis] == 0) {
      if (lower > 0 || upper < 0) return false;
      continue;
    }
    const double a = lower / ray.direction[axis], b = upper / ray.direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far + 1e-13 * std::abs(far);
}

struct Walk2 {
  const Bvh2& bvh;
  const OracleRay& ray;
  Shear shear;
  OracleHit hit;
  void node(int32_t index) {
    const wt_bvh2_node& n = bvh.nodes.at(static_cast<size_t>(index));
    for (int side = 0; side < 2; side++) {
      const wt_planes_xy& xy = side == 0 ? n.left : n.right;
      const float(&z)[2] = side == 0 ? n.left_z : n.right_z;
      if (!enters(ray, Box{{xy.x[0], xy.y[0], z[0]}, {xy.x[1], xy.y[1], z[1]}}, hit.t)) continue;
      const int32_t child = n.child[side];
      if (child >= 0) {
        node(child);
      } else {
        leaf(static_cast<uint32_t>(~child));
      }
    }
  }
  void leaf(uint32_t reference) {
    const uint32_t first = reference >> WT_LEAF_BITS, count = reference & ((1u << WT_LEAF_BITS) - 1);
    for (uint32_t slot = first; slot < first + count; slot++) {
      const wt_bvh2_triangle& triangle = bvh.triangles.at(shear.kz * bvh.triangle_slots + slot);
      const wt_float4* const corners[3] = {&triangle.a, &triangle.b, &triangle.c};
      Vertices v;
      for (size_t vertex = 0; vertex < 3; vertex++)
        for (size_t axis = 0; axis < 3; axis++) v[vertex][(shear.kz + 1 + axis) % 3] = corners[vertex]->s[axis];
      intersect(ray, shear, v, std::bit_cast<uint32_t>(triangle.a.s[3]), hit);
    }
  }
};

struct Walk8 {
  const Bvh8& bvh;
  const OracleRay& ray;
  Shear shear;
  OracleHit hit;
  void node(int32_t index) {
    const wt_bvh8_node& n = bvh.nodes.at(static_cast<size_t>(index));
    for (int lane = 0; lane < 8; lane++) {
      const auto plane = [&](int row) { return n.planes[row].s[lane]; };
      if (!enters(ray, Box{{plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}}, hit.t)) continue;
      const int32_t child = n.child[lane];
      if (child >= 0) {
        node(child);
      } else {
        leaf(static_cast<uint32_t>(~child));
      }
    }
  }
  void leaf(uint32_t reference) {
    const uint32_t first = reference >> WT_LEAF_BITS, count = reference & ((1u << WT_LEAF_BITS) - 1);
    for (uint32_t k = first; k < first + count; k++) {
      const wt_triangle_block& block = bvh.blocks.at(k);
      for (size_t lane = 0; lane < 4; lane++) {
        Vertices v;
        for (size_t row = 0; row < 9; row++) v[row / 3][row % 3] = block.corner[row].s[lane];
        intersect(ray, shear, v, block.primitive.s[lane], hit);
      }
    }
  }
};

}  // namespace

OracleHit trace_brute_force(std::span<const AccelTriangle> triangles, const OracleRay& ray) {
  const Shear shear(ray);
  OracleHit hit;
  for (const AccelTriangle& triangle : triangles) {
    Vertices v;
    for (size_t vertex = 0; vertex < 3; vertex++)
      for (size_t axis = 0; axis < 3; axis++) v[vertex][axis] = triangle.v[vertex][axis];
    intersect(ray, shear, v, triangle.primitive, hit);
  }
  return hit;
}

OracleHit trace(const Bvh2& bvh, const OracleRay& ray) {
  Walk2 walk{bvh, ray, Shear(ray), {}};
  walk.node(0);
  return walk.hit;
}

OracleHit trace(const Bvh8& bvh, const OracleRay& ray) {
  Walk8 walk{bvh, ray, Shear(ray), {}};
  walk.node(0);
  return walk.hit;
}

}  // namespace wavetracer::test
