// SPDX-License-Identifier: Apache-2.0
// The host decides in double. A ray that passes an edge within a tenth of a millimetre, which float32 cannot decide,
// does not count.
#include "simulation/check_traversal.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/digits.hpp"
#include "simulation/check_numbers.hpp"

namespace wavetracer {
namespace {

constexpr double edge_m = 1e-4;
constexpr uint32_t check_rays = 1000, neighbours = 16;

struct CheckRay {
  glm::vec3 origin, direction;
};

// Half of the rays leave one point, as in a launch; the others have independent lines.
std::vector<CheckRay> make_check_rays() {
  CheckNumbers numbers(7);
  const auto place = [&] {
    const double x = numbers.between(-30, 30), y = numbers.between(-30, 30);
    return glm::dvec3(x, y, numbers.between(0.3, 11));
  };
  std::vector<CheckRay> out;
  while (out.size() < check_rays) {
    const bool together = out.size() / neighbours % 2 == 0;
    const glm::dvec3 from = place(), to = place();
    for (uint32_t i = 0; i < (together ? neighbours : 1) && out.size() < check_rays; ++i) {
      const glm::dvec3 aside(numbers.between(-1, 1), numbers.between(-1, 1), numbers.between(-1, 1));
      out.push_back({from, glm::normalize(to - from + aside)});
    }
  }
  return out;
}

struct CheckTriangle {
  std::array<glm::dvec3, 3> v;
  uint32_t primitive, surface;
};

// Lists the triangles of the whole world, numbered as on the device.
std::vector<CheckTriangle> make_check_triangles(const Setup& s, const WorldState& state) {
  std::vector<CheckTriangle> out;
  const auto add = [&](const Scene& scene, uint32_t first_surface, const Placement& at) {
    for (size_t i = 0; i < scene.triangles.size(); ++i) {
      CheckTriangle triangle{{}, static_cast<uint32_t>(out.size()), first_surface + scene.triangle_surface[i]};
      for (size_t k = 0; k < 3; ++k)
        triangle.v[k] = at.position_m + at.rotation * scene.vertices[scene.triangles[i][k]];
      out.push_back(triangle);
    }
  };
  add(s.plan->scene, 0, {});
  for (size_t i = 0; i < s.plan->world.fleet.instances.size(); ++i) {
    const Instance& instance = s.plan->world.fleet.instances[i];
    add(s.plan->world.fleet.models[instance.model], instance.first_surface, state.instances[i]);
  }
  return out;
}

// The place where the line of the ray crosses the plane, and how far inside of the triangle that is: negative outside.
struct Crossing {
  double t, inside_m;
};

Crossing cross(const CheckTriangle& triangle, const glm::dvec3& origin, const glm::dvec3& direction) {
  constexpr Crossing none{-1, -1};
  const auto& v = triangle.v;
  const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
  const double along = glm::dot(normal, direction);
  if (std::abs(along) < 1e-12) return none;
  Crossing out{glm::dot(normal, v[0] - origin) / along, std::numeric_limits<double>::infinity()};
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 across = glm::cross(v[(i + 1) % 3] - v[i], direction);
    const double distance = glm::dot(across, origin - v[i]) / glm::length(across);
    out.inside_m = std::min(out.inside_m, along < 0 ? distance : -distance);
  }
  return out;
}

struct CheckHit {
  uint32_t primitive = WT_NONE, surface = WT_NONE;
  double t = std::numeric_limits<double>::infinity();
};

// The nearest triangle that the ray crosses at least this far inside.
CheckHit nearest(const std::vector<CheckTriangle>& triangles, const CheckRay& ray, double inside_m) {
  CheckHit out;
  for (const CheckTriangle& triangle : triangles) {
    const Crossing at = cross(triangle, ray.origin, ray.direction);
    if (at.inside_m > inside_m && at.t > 0 && at.t < out.t) out = {triangle.primitive, triangle.surface, at.t};
  }
  return out;
}

RayQueue upload_rays(gpu::Context& context, const std::vector<CheckRay>& rays) {
  RayQueue queue = make_ray_queue(context, rays.size(), "rays of a check");
  queue.count = static_cast<uint32_t>(rays.size());
  std::vector<float> planes(queue.planes.size(), 0.0f);
  for (size_t i = 0; i < rays.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      planes[size_t{WT_RAY_ORIGIN + uint32_t(axis)} * queue.capacity + i] = rays[i].origin[axis];
      planes[size_t{WT_RAY_DIRECTION + uint32_t(axis)} * queue.capacity + i] = rays[i].direction[axis];
    }
    planes[size_t{WT_RAY_NODE} * queue.capacity + i] = std::bit_cast<float>(uint32_t{WT_ROOT});
    planes[size_t{WT_RAY_SURFACE} * queue.capacity + i] = std::bit_cast<float>(uint32_t{WT_NONE});
  }
  queue.planes.write(planes);
  return queue;
}

std::vector<CheckHit> trace_rays(Setup& s, const std::vector<CheckRay>& rays) {
  const RayQueue queue = upload_rays(s.context, rays);
  HitList hits = make_hit_list(s.context, rays.size());
  Trace trace(s.context, s.device_scene, choose_shape(s.context.info(), s.plan->trace, s.order.plan));
  trace(s.device_scene, queue, hits);
  const auto plane = [&](size_t which) { return hits.planes.read(which * hits.capacity, rays.size()); };
  const std::vector<float> t = plane(WT_HIT_T), primitive = plane(WT_HIT_PRIMITIVE), surface = plane(WT_HIT_SURFACE);
  std::vector<CheckHit> out;
  for (size_t i = 0; i < rays.size(); ++i)
    out.push_back({std::bit_cast<uint32_t>(primitive[i]), std::bit_cast<uint32_t>(surface[i]), t[i]});
  return out;
}

}  // namespace

CheckResult check_traversal(Setup& setup, const WorldState& state) {
  const std::vector<CheckRay> rays = make_check_rays();
  const std::vector<CheckTriangle> triangles = make_check_triangles(setup, state);
  const std::vector<CheckHit> hits = trace_rays(setup, rays);
  size_t judged = 0, other = 0, distance = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const CheckHit right = nearest(triangles, rays[i], edge_m), wide = nearest(triangles, rays[i], -edge_m);
    if (right.primitive != wide.primitive) continue;
    ++judged;
    if (hits[i].primitive != right.primitive || hits[i].surface != right.surface)
      ++other;
    else if (right.primitive != WT_NONE && !(std::abs(hits[i].t - right.t) < edge_m * (1 + right.t)))
      ++distance;
  }
  if (judged < check_rays * 9 / 10)
    return {"traversal", false, fmt::format("only {} of {} rays could be judged", judged, grouped(check_rays))};
  if (other + distance == 0)
    return {"traversal", true, fmt::format("{} rays hit what they should hit", grouped(judged))};
  return {"traversal", false,
          fmt::format("of {} rays {} hit a wrong triangle, and {} hit the right one at a wrong distance",
                      grouped(judged), grouped(other), grouped(distance))};
}

}  // namespace wavetracer
