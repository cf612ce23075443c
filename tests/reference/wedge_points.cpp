// SPDX-License-Identifier: Apache-2.0
// The length of a path over straight edges is convex in the positions of its points on them, so its derivatives grow,
// and bisection finds where they vanish. Two edges: the inner minimum is followed while the outer one is sought.
#include "reference/wedge_points.hpp"
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include "reference/planes.hpp"

namespace wavetracer::reference {
namespace {

using glm::dvec3;

constexpr double azimuth_tolerance_rad = 1e-9;

dvec3 at(const Wedge& wedge, double x_m) { return wedge.start + x_m * wedge.along; }

// The derivative by x of the distance from a to the edge's point at x.
double slope(const Wedge& wedge, double x_m, const dvec3& a) {
  const dvec3 from = at(wedge, x_m) - a;
  return glm::dot(wedge.along, from) / glm::length(from);
}

// Finds where a growing function of x in [0, length_m] vanishes; the nearer end if that is outside.
template <typename Function>
double vanishing(const Function& function, double length_m) {
  if (function(0.0) >= 0) return 0;
  if (function(length_m) <= 0) return length_m;
  double below = 0, above = length_m;
  for (double middle = above / 2; middle > below && middle < above; middle = below + (above - below) / 2)
    (function(middle) < 0 ? below : above) = middle;
  return above;
}

template <typename Function>
bool vanishes(const Function& function, double length_m) {
  return function(0.0) <= 0 && function(length_m) >= 0;
}

auto slope_between(const Wedge& wedge, const dvec3& a, const dvec3& b) {
  return [=](double x_m) { return slope(wedge, x_m, a) + slope(wedge, x_m, b); };
}

}  // namespace

std::optional<dvec3> diffraction_point(const Wedge& wedge, const dvec3& a, const dvec3& b) {
  const auto total = slope_between(wedge, a, b);
  if (!vanishes(total, wedge.length_m)) return std::nullopt;
  return at(wedge, vanishing(total, wedge.length_m));
}

std::optional<std::array<dvec3, 2>> diffraction_points(const Wedge& first, const Wedge& second, const dvec3& a,
                                                       const dvec3& b) {
  // If q is optimal for each p, the derivative by p is that with q fixed (the envelope theorem). It does not exist
  // where edges meet, so ends are tested a nanometre inside.
  const auto total = [&](double at_m) {
    const double x_m = std::clamp(at_m, 1e-9, first.length_m - 1e-9);
    const double best_m = vanishing(slope_between(second, at(first, x_m), b), second.length_m);
    return slope(first, x_m, a) + slope(first, x_m, at(second, best_m));
  };
  if (!vanishes(total, first.length_m)) return std::nullopt;
  const dvec3 p = at(first, vanishing(total, first.length_m));
  const auto q = diffraction_point(second, p, b);
  if (!q) return std::nullopt;
  return std::array{p, *q};
}

bool is_corner(const Wedge& wedge) { return wedge.exterior_rad < std::numbers::pi; }

bool is_faint(const Wedge& wedge, const dvec3& a, const dvec3& b, double wavelength_m) {
  using std::numbers::pi;
  if (wedge.exterior_rad > pi + 1e-3 || wedge.exterior_rad <= pi / 2) return false;
  const auto azimuth = [&](const dvec3& p) {
    return std::atan2(glm::dot(p - wedge.start, wedge.normal), glm::dot(p - wedge.start, wedge.face));
  };
  const auto away_m = [&](const dvec3& p) { return glm::length(glm::cross(p - wedge.start, wedge.along)); };
  const double in = azimuth(a), out = azimuth(b), r = away_m(a), s = away_m(b);
  const double between_m = std::hypot(r + s, glm::dot(b - a, wedge.along));
  const double root = std::sqrt(4 * pi * pi * r * s / between_m / wavelength_m);
  for (const double off : {pi - in - out, pi + in + out - 2 * wedge.exterior_rad, pi + in - out, pi - in + out,
                           pi + in - out - 2 * wedge.exterior_rad, pi - in + out - 2 * wedge.exterior_rad})
    if (!(1 / (2 * std::abs(std::sin(off / 2)) * root) < 0.01)) return false;
  return true;
}

bool in_free_sector(const Wedge& wedge, const dvec3& point, const dvec3& neighbour) {
  const dvec3 d = neighbour - point;
  const double x = glm::dot(d, wedge.face), y = glm::dot(d, wedge.normal);
  if (std::hypot(x, y) <= same_vertex_m) return false;
  const double azimuth = std::atan2(y, x);
  constexpr double turn = 2 * std::numbers::pi;
  return (azimuth < 0 ? azimuth + turn : azimuth) <= wedge.exterior_rad + azimuth_tolerance_rad ||
         std::abs(azimuth) <= azimuth_tolerance_rad;
}

}  // namespace wavetracer::reference
