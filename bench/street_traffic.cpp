// SPDX-License-Identifier: Apache-2.0
// All parts of the scene above the kerb are obstacles, at any height, so that all tests are plane geometry: rectangles
// on the ground against the footprints of triangles, by the separating axis theorem.
#include "street_traffic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <span>

#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kerb_m = 0.3, least_speed_m_s = 5, most_speed_m_s = 14;
constexpr double clear_at_start_m = 2.5, strip_m = 3, ahead_m = 4, gap_m = 6;
constexpr double point_width_m = 0.5;  // width of the strip of a vehicle without a size
constexpr int directions = 24;         // tried from each place, and back from the end of a way

struct Type {
  const char* name;
  unsigned percent;
  double length_m;  // that of SUMO's class of this name, which the simulation uses
};
constexpr Type types[] = {{"passenger", 85, 5}, {"delivery", 8, 6.5}, {"truck", 7, 7.1}};

// A convex polygon in the plane of the ground, with its bounding box.
struct Footprint {
  std::array<dvec2, 4> corners{};
  size_t count = 0;
  dvec2 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};

  void add(const dvec2& corner) {
    corners[count++] = corner;
    lower = glm::min(lower, corner);
    upper = glm::max(upper, corner);
  }
};

struct Rectangle {
  dvec2 centre, ahead;  // ahead: a unit vector
  double half_length_m, half_width_m;
};

dvec2 left_of(const dvec2& v) { return {-v.y, v.x}; }

// Tells whether `axis` separates the two.
bool apart(const dvec2& axis, const Rectangle& r, std::span<const dvec2> corners) {
  const double middle = glm::dot(axis, r.centre);
  const double half =
      r.half_length_m * std::abs(glm::dot(axis, r.ahead)) + r.half_width_m * std::abs(glm::dot(axis, left_of(r.ahead)));
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const dvec2& corner : corners) {
    least = std::min(least, glm::dot(axis, corner));
    most = std::max(most, glm::dot(axis, corner));
  }
  return least > middle + half || most < middle - half;
}

class Ground {
 public:
  explicit Ground(const Scene& scene) {
    for (const auto& triangle : scene.triangles) {
      std::array<dvec3, 3> corners;
      for (size_t k = 0; k < 3; k++) corners[k] = scene.vertices[triangle[k]] + scene.origin_m;
      if (std::max({corners[0].z, corners[1].z, corners[2].z}) > kerb_m)
        add_obstacle(corners);
      else
        ground_.push_back(corners);
    }
  }

  bool free(const Rectangle& r) const {
    const dvec2 reach = r.half_length_m * glm::abs(r.ahead) + r.half_width_m * glm::abs(left_of(r.ahead));
    const dvec2 lower = r.centre - reach, upper = r.centre + reach;
    return std::none_of(obstacles_.begin(), obstacles_.end(), [&](const Footprint& f) {
      if (f.lower.x > upper.x || f.lower.y > upper.y || f.upper.x < lower.x || f.upper.y < lower.y) return false;
      const std::span<const dvec2> corners(f.corners.data(), f.count);
      if (apart(r.ahead, r, corners) || apart(left_of(r.ahead), r, corners)) return false;
      for (size_t k = 0; k < f.count; k++)
        if (apart(left_of(f.corners[(k + 1) % f.count] - f.corners[k]), r, corners)) return false;
      return true;
    });
  }

  // Returns the height of the highest ground at a place; nothing if there is none.
  std::optional<double> height_at(const dvec2& p) const {
    std::optional<double> height_m;
    for (const auto& [a, b, c] : ground_) {
      const double u = area(b, c, p), v = area(c, a, p), w = area(a, b, p), sum = u + v + w;
      const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
      if (!inside || sum == 0) continue;
      const double z = (u * a.z + v * b.z + w * c.z) / sum;
      if (!height_m || z > *height_m) height_m = z;
    }
    if (height_m && *height_m < -kerb_m) return std::nullopt;
    return height_m;
  }

 private:
  // Returns twice the signed area of the triangle (a, b, p) seen from above.
  static double area(const dvec3& a, const dvec3& b, const dvec2& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  }

  // Adds the part of the triangle above the kerb; it has four corners if one of three is cut off.
  void add_obstacle(const std::array<dvec3, 3>& corners) {
    Footprint f;
    for (size_t k = 0; k < 3; k++) {
      const dvec3 &from = corners[k], &to = corners[(k + 1) % 3];
      if (from.z > kerb_m) f.add(dvec2(from));
      if ((from.z > kerb_m) != (to.z > kerb_m)) f.add(dvec2(from + (kerb_m - from.z) / (to.z - from.z) * (to - from)));
    }
    obstacles_.push_back(f);
  }

  std::vector<Footprint> obstacles_;
  std::vector<std::array<dvec3, 3>> ground_;
};

// A circle that moves along a straight line.
struct Drive {
  dvec2 start, velocity_m_s;
  double radius_m;
};

bool keep_apart(const Drive& a, const Drive& b, double duration_s) {
  const dvec2 between = b.start - a.start, velocity = b.velocity_m_s - a.velocity_m_s;
  const double speed2 = glm::dot(velocity, velocity);
  const double nearest_s = speed2 > 0 ? std::clamp(-glm::dot(between, velocity) / speed2, 0.0, duration_s) : 0;
  return glm::length(between + nearest_s * velocity) >= gap_m + a.radius_m + b.radius_m;
}

double millimetres(double metres) { return std::round(metres * 1e3) / 1e3; }

}  // namespace

std::vector<TrackConfig> street_traffic(const Scene& scene, const StreetTraffic& traffic) {
  const Ground ground(scene);
  std::mt19937_64 generator(traffic.seed);  // distributions of the standard library differ from one to the next
  const auto draw = [&](double from, double to) {
    return from + (to - from) * 0x1p-53 * static_cast<double>(generator() >> 11);
  };
  std::vector<Drive> drives;
  for (const dvec3& place : traffic.standing_m) drives.push_back({dvec2(place), dvec2(0), 0});
  const auto draw_type = [&] {
    double percent = draw(0, 100);
    const Type* type = types;
    while (percent >= type->percent) percent -= (type++)->percent;
    return *type;
  };

  std::vector<TrackConfig> tracks;
  Type type = draw_type();
  for (size_t tries = 0; tracks.size() < traffic.vehicles; tries++) {
    if (tries > 500 * traffic.vehicles + 5000)
      throw InputError(
          fmt::format("{}: only {} of {} vehicles find a free way of {} s within {} m of ({}, {}): drive fewer, "
                      "shorter or in a larger part of the scene",
                      scene.file, tracks.size(), traffic.vehicles, traffic.duration_s, traffic.radius_m,
                      traffic.centre_m.x, traffic.centre_m.y));
    const dvec2 offset(draw(-traffic.radius_m, traffic.radius_m), draw(-traffic.radius_m, traffic.radius_m));
    const double speed_m_s = draw(least_speed_m_s, most_speed_m_s), first_angle_rad = draw(0, 2 * std::numbers::pi);
    if (glm::length(offset) > traffic.radius_m) continue;
    const dvec2 start(millimetres(traffic.centre_m.x + offset.x), millimetres(traffic.centre_m.y + offset.y));
    const auto start_z = ground.height_at(start);
    if (!start_z || !ground.free({start, {1, 0}, clear_at_start_m, clear_at_start_m})) continue;
    for (int k = 0; k < directions; k++) {
      const double angle_rad = first_angle_rad + 2 * std::numbers::pi * k / directions;
      const dvec2 ahead(std::cos(angle_rad), std::sin(angle_rad));
      const double length_m = speed_m_s * traffic.duration_s;
      const dvec2 end(millimetres(start.x + length_m * ahead.x), millimetres(start.y + length_m * ahead.y));
      const Drive drive{start, (end - start) / traffic.duration_s, type.length_m / 2};
      const bool alone = std::all_of(drives.begin(), drives.end(),
                                     [&](const Drive& other) { return keep_apart(drive, other, traffic.duration_s); });
      if (!alone || !ground.free({(start + end) / 2.0, ahead, length_m / 2 + ahead_m, strip_m / 2})) continue;
      const auto end_z = ground.height_at(end);
      if (!end_z) continue;
      drives.push_back(drive);
      tracks.push_back({.id = fmt::format("car{}", tracks.size()),
                        .type = type.name,
                        .waypoints = {{0, start.x, start.y, millimetres(*start_z)},
                                      {traffic.duration_s, end.x, end.y, millimetres(*end_z)}}});
      type = draw_type();
      break;
    }
  }
  return tracks;
}

std::vector<dvec3> free_ways_to(const Scene& scene, dvec3 end_m, double length_m, size_t most) {
  const Ground ground(scene);
  std::vector<dvec3> free;
  for (int k = 0; k < directions; k++) {
    const double angle_rad = 2 * std::numbers::pi * k / directions;
    const dvec2 ahead(std::cos(angle_rad), std::sin(angle_rad));
    const dvec2 start = dvec2(end_m) - length_m * ahead;
    if (ground.free({(start + dvec2(end_m)) / 2.0, ahead, length_m / 2, point_width_m / 2}))
      free.emplace_back(start, end_m.z);
  }
  if (free.empty())
    throw InputError(fmt::format("{}: no straight way of {} m leads to ({}, {}) without a wall in it", scene.file,
                                 length_m, end_m.x, end_m.y));
  std::vector<dvec3> spread;
  const size_t count = std::min(most, free.size());
  for (size_t i = 0; i < count; i++) spread.push_back(free[i * free.size() / count]);
  return spread;
}

}  // namespace wavetracer::bench
