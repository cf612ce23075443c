// SPDX-License-Identifier: Apache-2.0
// Follows lines through the grid of the scene's triangles. Lines that count crossings are a little oblique, so that
// they seldom meet an edge, where two triangles or none would count.
#include "simulation/surroundings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/topology.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;

// Lines up and to four sides, of which two climb and two fall: a flat sheet of any width is not met by all of them.
const std::array<dvec3, 5> leaving = {dvec3{0.0137, 0.0291, 1}, dvec3{1, 0.0431, 0.0573}, dvec3{-0.0523, 1, -0.0197},
                                      dvec3{-1, -0.0337, 0.0631}, dvec3{0.0217, -1, -0.0173}};

// The square of the distance between p and a triangle (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
double square_distance(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
  const dvec3 normal = glm::cross(b - a, c - a);
  const auto outside = [&](const dvec3& from, const dvec3& to) {
    return glm::dot(glm::cross(to - from, p - from), normal) < 0;
  };
  const auto to_side = [&](const dvec3& from, const dvec3& to) {
    const dvec3 side = to - from;
    const dvec3 off = p - from - std::clamp(glm::dot(p - from, side) / glm::dot(side, side), 0.0, 1.0) * side;
    return glm::dot(off, off);
  };
  if (!outside(a, b) && !outside(b, c) && !outside(c, a)) {
    const double height = glm::dot(p - a, normal);
    return height * height / glm::dot(normal, normal);
  }
  return std::min({to_side(a, b), to_side(b, c), to_side(c, a)});
}

double volume(const SceneBox& box) {
  const dvec3 size = box.upper - box.lower;
  return size.x * size.y * size.z;
}

}  // namespace

struct Surroundings::Index {
  TriangleGrid triangles;
  std::vector<uint32_t> body;  // body of each triangle
  std::vector<SceneBox> body_box, object_box;
  std::vector<uint32_t> wide_surfaces;  // surfaces of objects that are as wide as a ground

  explicit Index(const Scene& scene);
  void join_bodies(const Scene& scene);
  bool is_wide(const Scene& scene, uint32_t object) const {
    const dvec3 size = scene.upper - scene.lower, wide = object_box[object].upper - object_box[object].lower;
    return wide.x * wide.y >= 0.5 * size.x * size.y;
  }
  // The wide object in whose plane p is, if that plane has a hole at p, as below a house.
  std::optional<uint32_t> wide_object_at(const Scene& scene, const dvec3& p) const;
};

Surroundings::Index::Index(const Scene& scene) : triangles(scene) {
  join_bodies(scene);
  const std::vector<SceneBox>& boxes = triangles.boxes();
  object_box.resize(scene.objects.size(), {dvec3(1e300), dvec3(-1e300)});
  for (uint32_t t = 0; t < boxes.size(); ++t) object_box[scene.triangle_object[t]].grow(boxes[t]);
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i)
    if (is_wide(scene, scene.surfaces[i].object)) wide_surfaces.push_back(i);
}

std::optional<uint32_t> Surroundings::Index::wide_object_at(const Scene& scene, const dvec3& p) const {
  for (const uint32_t i : wide_surfaces) {
    const Surface& s = scene.surfaces[i];
    if (p.x >= s.lower.x && p.x <= s.upper.x && p.y >= s.lower.y && p.y <= s.upper.y &&
        std::abs(glm::dot(s.normal, p) - s.offset_m) <= on_surface_m)
      return s.object;
  }
  return {};
}

void Surroundings::Index::join_bodies(const Scene& scene) {
  const std::vector<SceneBox>& boxes = triangles.boxes();
  body = bodies_of(scene);
  for (uint32_t t = 0; t < boxes.size(); ++t) {
    if (body[t] == body_box.size()) body_box.push_back(boxes[t]);
    body_box[body[t]].grow(boxes[t]);
  }
}

Surroundings::Surroundings(const Scene& scene) : scene_(scene), index_(std::make_unique<Index>(scene)) {}
Surroundings::~Surroundings() = default;
Surroundings::Surroundings(Surroundings&&) noexcept = default;

std::vector<Surroundings::Crossing> Surroundings::crossings(const dvec3& a, const dvec3& b) const {
  return index_->triangles.crossings(a, b);
}

std::optional<Surroundings::Body> Surroundings::body_at(const dvec3& p) const {
  const double far_m = glm::length(scene_.upper - scene_.lower) + 1;
  struct Around {
    uint32_t body;
    Crossing nearest;
  };
  std::vector<Around> around;  // bodies that all lines so far leave
  for (size_t k = 0; k < leaving.size(); ++k) {
    std::vector<Around> odd;
    for (const Crossing& c : crossings(p, p + far_m * glm::normalize(leaving[k]))) {
      if (c.distance_m <= on_surface_m) continue;  // a surface that p is on is not around it
      const auto found = std::ranges::find(odd, index_->body[c.triangle], &Around::body);
      if (found == odd.end())
        odd.push_back({index_->body[c.triangle], c});
      else
        odd.erase(found);
    }
    if (k == 0) around = odd;
    std::erase_if(around, [&](Around& body) {
      const auto found = std::ranges::find(odd, body.body, &Around::body);
      if (found == odd.end()) return true;
      if (found->nearest.distance_m < body.nearest.distance_m) body.nearest = found->nearest;
      return false;
    });
    if (around.empty()) return {};
  }
  // If bodies are inside of one another, this takes the smallest.
  const auto inner =
      std::ranges::min_element(around, {}, [&](const Around& a) { return volume(index_->body_box[a.body]); });
  return Body{inner->body, scene_.triangle_object[inner->nearest.triangle]};
}

bool Surroundings::small(const Body& body) const {
  return volume(index_->body_box[body.number]) < 0.5 * volume({scene_.lower, scene_.upper});
}

std::optional<Surroundings::Depth> Surroundings::below_ground(const dvec3& p) const {
  const double top_m = scene_.upper.z + 1, bottom_m = scene_.lower.z - 1;
  if (p.z > top_m) return {};
  const std::vector<Crossing> above = crossings(p, {p.x, p.y, top_m});
  if (above.empty() || above.front().distance_m <= on_surface_m) return {};
  if (p.z > bottom_m && !crossings(p, {p.x, p.y, bottom_m}).empty()) return {};
  const double depth_m = above.front().distance_m;
  const uint32_t object = scene_.triangle_object[above.front().triangle];
  if (index_->is_wide(scene_, object)) return Depth{depth_m, object};
  const std::optional<uint32_t> ground = index_->wide_object_at(scene_, p + dvec3(0, 0, depth_m));
  return ground ? std::optional(Depth{depth_m, *ground}) : std::nullopt;
}

bool Surroundings::has_ground() const {
  constexpr int places = 9;  // number in x and in y
  const dvec3 size = scene_.upper - scene_.lower;
  int found = 0;
  for (int k = 0; k < places * places; ++k) {
    const double x = scene_.lower.x + size.x * (k % places + 0.5) / places,
                 y = scene_.lower.y + size.y * (k / places + 0.5) / places;
    found += !crossings({x, y, scene_.upper.z + 1}, {x, y, scene_.lower.z - 1}).empty();
  }
  return 2 * found >= places * places;
}

std::optional<double> Surroundings::height_above(const dvec3& p, double rise_m) const {
  const double bottom_m = scene_.lower.z - 1;
  if (p.z + rise_m <= bottom_m) return {};
  const std::vector<Crossing> below = crossings(p + dvec3(0, 0, rise_m), {p.x, p.y, bottom_m});
  if (below.empty()) return {};
  return below.front().distance_m - rise_m;
}

std::optional<uint32_t> Surroundings::object_at(const dvec3& p) const {
  for (int axis = 0; axis < 3; ++axis)
    if (p[axis] < scene_.lower[axis] - on_surface_m || p[axis] > scene_.upper[axis] + on_surface_m) return {};
  std::optional<uint32_t> lowest;
  const TriangleGrid& triangles = index_->triangles;
  triangles.grid().visit_box({p - on_surface_m, p + on_surface_m}, [&](uint32_t cell) {
    for (const uint32_t t : triangles[cell]) {
      const auto& [i, j, k] = scene_.triangles[t];
      if (square_distance(p, scene_.vertices[i], scene_.vertices[j], scene_.vertices[k]) <= on_surface_m * on_surface_m)
        lowest = std::min(lowest.value_or(t), t);
    }
  });
  if (!lowest) return {};
  return scene_.triangle_object[*lowest];
}

double Surroundings::outside_m(const dvec3& p) const {
  const double x = std::max({scene_.lower.x - p.x, p.x - scene_.upper.x, 0.0});
  const double y = std::max({scene_.lower.y - p.y, p.y - scene_.upper.y, 0.0});
  return std::hypot(x, y);
}

std::string Surroundings::name_of(uint32_t object) const { return fmt::format("\"{}\"", scene_.objects[object]); }

}  // namespace wavetracer
