// SPDX-License-Identifier: Apache-2.0
// Bodies of tests, and radar cross sections of them.
#pragma once
#include <array>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>

#include "bodies/physical_optics.hpp"
#include "radio/constants.hpp"

namespace wavetracer {

inline constexpr double pi = std::numbers::pi;
inline constexpr double wave_m = 0.01, wave_hz = speed_of_light_m_s / wave_m;
inline constexpr double far_m = 1e6;

inline glm::dvec3 towards(double theta_deg, double phi_deg) {
  const double theta = theta_deg * pi / 180, phi = phi_deg * pi / 180;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

inline Body conductor(std::vector<Polygon> polygons) {
  Body body;
  body.materials = {{}};
  for (Polygon& polygon : polygons) body.facets.push_back({std::move(polygon), 0});
  return body;
}

// The parallelogram with this corner and these sides.
inline Polygon parallelogram(glm::dvec3 corner, glm::dvec3 a, glm::dvec3 b) {
  return {corner, corner + a, corner + a + b, corner + b};
}

// A box with a corner at the origin.
inline Body box(glm::dvec3 size) {
  std::vector<Polygon> faces;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 a(0), b(0), c(0);
    a[axis] = size[axis];
    b[(axis + 1) % 3] = size[(axis + 1) % 3];
    c[(axis + 2) % 3] = size[(axis + 2) % 3];
    faces.push_back(parallelogram(a, b, c));
    faces.push_back(parallelogram({0, 0, 0}, c, b));
  }
  return conductor(faces);
}

// Radar cross sections in dB over 1 m^2, theta to theta and so on row by row, of ends far away in these directions.
inline std::array<double, 4> cross_section_db(const Body& body, glm::dvec3 from, glm::dvec3 to,
                                              const PhysicalOptics& options = {}) {
  std::array<double, 4> out = cross_sections_m2(body, from, to, wave_hz, options);
  for (double& value : out) value = 10 * std::log10(value);
  return out;
}

inline double db(double value) { return 10 * std::log10(value); }
inline double sinc(double x) { return x == 0 ? 1 : std::sin(x) / x; }

}  // namespace wavetracer
