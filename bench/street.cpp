// SPDX-License-Identifier: Apache-2.0
// Draws points in a disc and keeps those with only sky above, by testing every triangle: a few million tests in all.
// The generator is that of the standard, whose numbers are the same with every library; distributions are not used.
#include "street.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <random>

#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

using glm::dvec3;

constexpr double ground_tolerance_m = 0.5;  // covers kerbs and uneven ground; roofs are higher

// Returns twice the signed area of the triangle (a, b, p) seen from above.
double area(const dvec3& a, const dvec3& b, double x, double y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// Returns the height at which a ray straight down at (x, y) first meets the scene, recentred; -infinity if it meets
// nothing.
double highest(const Scene& scene, double x, double y) {
  double result = -std::numeric_limits<double>::infinity();
  for (const auto& triangle : scene.triangles) {
    const dvec3 &a = scene.vertices[triangle[0]], &b = scene.vertices[triangle[1]], &c = scene.vertices[triangle[2]];
    const double u = area(b, c, x, y), v = area(c, a, x, y), w = area(a, b, x, y), sum = u + v + w;
    const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    if (inside && sum != 0) result = std::max(result, (u * a.z + v * b.z + w * c.z) / sum);
  }
  return result;
}

}  // namespace

std::vector<dvec3> street_points(const Scene& scene, dvec3 centre_m, double radius_m, double height_m, size_t count) {
  std::mt19937 generator(1);
  const auto draw = [&](double centre) {  // returns a value in centre +- radius_m, to a millimetre
    return std::round((centre + (static_cast<double>(generator()) * 0x1p-31 - 1) * radius_m) * 1e3) / 1e3;
  };
  std::vector<dvec3> points;
  for (size_t tries = 0; points.size() < count; tries++) {
    if (tries > 100 * count + 1000)
      throw InputError(
          fmt::format("{}: only {} of {} places within {} m of ({}, {}) are open to the sky at z = 0; "
                      "is this a city with streets at z = 0?",
                      scene.file, points.size(), count, radius_m, centre_m.x, centre_m.y));
    const double x = draw(centre_m.x), y = draw(centre_m.y);
    if (std::hypot(x - centre_m.x, y - centre_m.y) > radius_m) continue;
    const dvec3 point(x, y, height_m);
    const double top = highest(scene, point.x - scene.origin_m.x, point.y - scene.origin_m.y) + scene.origin_m.z;
    if (std::abs(top) <= ground_tolerance_m) points.push_back(point);
  }
  return points;
}

}  // namespace wavetracer::bench
