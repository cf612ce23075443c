// SPDX-License-Identifier: Apache-2.0
// trace_rays: nearest and any hits of packed rays against all triangles in turn, by the test of T. Möller and B.
// Trumbore (1997) in double; and the distances of trace, bit for bit.
#include "passes/trace_rays.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <stdexcept>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr float endless = std::numeric_limits<float>::infinity();

struct PackedScene {
  Scene scene;
  DeviceTrees trees;
  std::vector<float> corners;
  explicit PackedScene(const std::vector<Corners>& triangles, float extent_m, bool splits = false)
      : scene(scene_of_triangles(triangles)) {
    const std::vector<AccelTriangle> accel = accel_triangles(scene);
    trees = make_device_trees(context(), accel, splits, extent_m);
    for (const AccelTriangle& t : accel)
      for (const auto& corner : t.v) corners.insert(corners.end(), corner, corner + 3);
  }
};

// Rays from inside and outside of a cube, of many lengths; some begin late, some end early.
std::vector<wt_packed_ray> packed_rays(size_t count, double extent, uint32_t seed) {
  Random random(seed);
  std::vector<wt_packed_ray> rays;
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec3 from = random.in_cube(extent * (i % 2 ? 2 : 1));
    const double scale = i % 3 ? 1 : random.between(0.1, 30);
    const glm::dvec3 along = scale * random.direction();
    const double reach = extent / scale;
    wt_packed_ray ray{{}, i % 4 == 1 ? static_cast<float>(random.between(0, reach)) : 0.0f, {}, endless};
    if (i % 5 == 1) ray.t_max = ray.t_min + static_cast<float>(random.between(0, 2 * reach));
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = static_cast<float>(from[axis]);
      ray.direction[axis] = static_cast<float>(along[axis]);
    }
    rays.push_back(ray);
  }
  return rays;
}

struct Meeting {
  double t, u, v;
  bool sure;  // it does not depend on rounding
};

// Möller and Trumbore; a meeting beside the triangle, too, where rounding could decide otherwise.
std::optional<Meeting> meeting(const wt_packed_ray& ray, const float* corners) {
  const auto vec = [](const float* p) { return glm::dvec3(p[0], p[1], p[2]); };
  const glm::dvec3 a = vec(corners), ab = vec(corners + 3) - a, ac = vec(corners + 6) - a, d = vec(ray.direction);
  const glm::dvec3 p = glm::cross(d, ac);
  const double det = glm::dot(ab, p);
  if (det == 0) return {};
  const glm::dvec3 s = vec(ray.origin) - a, q = glm::cross(s, ab);
  const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, t = glm::dot(ac, q) / det;
  const double inside = std::min({u, v, 1 - u - v}), slack = 1e-4;
  if (inside < -slack || !(t > ray.t_min * (1 - slack) - slack) || !(t <= ray.t_max * (1 + slack) + slack)) return {};
  const bool sure = inside > slack && t > ray.t_min * (1 + slack) + slack && t < ray.t_max * (1 - slack) - slack;
  return Meeting{t, u, v, sure};
}

struct Expected {
  bool certain = true;  // the answer does not depend on rounding
  std::optional<uint32_t> primitive;
  Meeting at{};
};

Expected nearest_of(const wt_packed_ray& ray, const std::vector<float>& corners) {
  Expected out;
  double unsure = std::numeric_limits<double>::infinity();
  for (uint32_t i = 0; i < corners.size() / 9; ++i) {
    const std::optional<Meeting> m = meeting(ray, corners.data() + size_t{9} * i);
    if (!m) continue;
    if (!m->sure || (out.primitive && std::abs(m->t - out.at.t) < 1e-3)) unsure = std::min(unsure, m->t);
    if (m->sure && (!out.primitive || m->t < out.at.t)) {
      out.primitive = i;
      out.at = *m;
    }
  }
  out.certain = unsure > (out.primitive ? out.at.t + 1e-3 : std::numeric_limits<double>::max());
  return out;
}

size_t wrong_hits(const PackedScene& world, const std::vector<wt_packed_ray>& rays, size_t* certain) {
  TraceRays pass(context(), world.trees);
  const auto given = context().buffer(rays, "rays");
  const auto count = static_cast<uint32_t>(rays.size());
  auto hits = context().buffer(std::vector<wt_packed_hit>(rays.size() + 1, {7, 7, 7, 7}), "hits");
  auto met = context().buffer(std::vector<uint32_t>(rays.size() + 1, 7), "met");
  pass.nearest(world.trees, context().buffer(world.corners, "corners"), given, count, hits);
  pass.any(world.trees, given, count, met);
  const std::vector<wt_packed_hit> found = hits.read();
  const std::vector<uint32_t> any = met.read();
  size_t wrong = found[count].primitive != 7 || any[count] != 7;  // nothing is written behind them
  for (size_t i = 0; i < rays.size(); ++i) {
    const Expected expected = nearest_of(rays[i], world.corners);
    wrong += any[i] != (found[i].primitive != WT_NONE);
    if (!expected.certain) continue;
    ++*certain;
    if (!expected.primitive) {
      wrong += found[i].primitive != WT_NONE || found[i].t != endless || found[i].u != 0 || found[i].v != 0;
      continue;
    }
    wrong += found[i].primitive != *expected.primitive || std::abs(found[i].t - expected.at.t) > 1e-4 ||
             std::abs(found[i].u - expected.at.u) > 1e-3 || std::abs(found[i].v - expected.at.v) > 1e-3;
  }
  return wrong;
}

}  // namespace

TEST_CASE("packed rays: the hits of Möller and Trumbore's test, in any length, from t_min to t_max") {
  const uint32_t count = as_many(1000, 60);
  for (const uint32_t seed : {1u, 2u}) {
    CAPTURE(seed);
    const PackedScene world(random_soup(seed == 1 ? 200 : 40, 10, 4, seed), 20, seed == 2);
    size_t certain = 0;
    CHECK(wrong_hits(world, packed_rays(count, 10, seed + 5), &certain) == 0);
    CHECK(certain > 0.9 * count);
  }
}

TEST_CASE("a few triangles, one, and none; rays that are not numbers") {
  for (const size_t triangles : {0u, 1u, 5u}) {
    CAPTURE(triangles);
    std::vector<Corners> soup = random_soup(5, 10, 8, 3);
    soup.resize(triangles);
    const PackedScene world(soup, 20);
    size_t certain = 0;
    std::vector<wt_packed_ray> rays = packed_rays(100, 10, 4);
    CHECK(wrong_hits(world, rays, &certain) == 0);
    for (wt_packed_ray& ray : rays) ray.direction[1] = std::numeric_limits<float>::quiet_NaN();
    auto met = context().buffer(std::vector<uint32_t>(rays.size(), 7), "met");
    TraceRays(context(), world.trees).any(world.trees, context().buffer(rays, "rays"), 100, met);
    CHECK(met.read() == std::vector<uint32_t>(rays.size(), 0));
  }
}

TEST_CASE("the nearest hit of a packed ray is the one that trace finds, to the last bit") {
  const PackedScene world(random_soup(300, 10, 4, 8), 20);
  std::vector<wt_packed_ray> rays = packed_rays(as_many(600, 50), 10, 9);
  std::vector<Ray> queued;
  for (wt_packed_ray& ray : rays) {
    ray.t_min = 0;
    ray.t_max = endless;
    queued.push_back(
        {{ray.origin[0], ray.origin[1], ray.origin[2]}, {ray.direction[0], ray.direction[1], ray.direction[2]}});
  }
  auto hits = context().buffer<wt_packed_hit>(rays.size(), "hits");
  TraceRays(context(), world.trees)
      .nearest(world.trees, context().buffer(world.corners, "corners"), context().buffer(rays, "rays"),
               static_cast<uint32_t>(rays.size()), hits);
  const std::vector<wt_packed_hit> found = hits.read();
  for (const TraceShape shape : shapes()) {
    CAPTURE(name_of(shape));
    const RayQueue queue = upload(queued);
    HitList list = make_hit_list(context(), queued.size());
    Trace(context(), world.trees, shape)(world.trees, queue, list);
    const std::vector<Hit> expected = download(list, queued.size());
    size_t different = 0;
    for (size_t i = 0; i < found.size(); ++i)
      different +=
          found[i].primitive != expected[i].primitive || (!expected[i].missed() && found[i].t != expected[i].t);
    CHECK(different == 0);
  }
}

TEST_CASE("faults of the caller of trace_rays: buffers that are too short") {
  const PackedScene world(random_soup(3, 10, 4, 8), 20);
  TraceRays pass(context(), world.trees);
  auto rays = context().buffer<wt_packed_ray>(10, "rays");
  auto hits = context().buffer<wt_packed_hit>(10, "hits");
  auto met = context().buffer<uint32_t>(9, "met");
  const auto corners = context().buffer(world.corners, "corners");
  CHECK_THROWS_AS(pass.nearest(world.trees, corners, rays, 11, hits), std::invalid_argument);
  CHECK_THROWS_AS(pass.nearest(world.trees, context().buffer<float>(26, "corners"), rays, 10, hits),
                  std::invalid_argument);
  CHECK_THROWS_AS(pass.any(world.trees, rays, 10, met), std::invalid_argument);
  CHECK_NOTHROW(pass.any(world.trees, rays, 0, met));
}
