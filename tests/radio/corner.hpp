// SPDX-License-Identifier: Apache-2.0
// The geometrical field of a point source near a wedge by explicit images, and the total with its diffracted wave.
// Assumes a wedge along z, face 0 on the half plane y = 0, x > 0; vectors of fields, nothing edge-fixed.
#pragma once
#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "radio/material.hpp"
#include "radio/slab.hpp"
#include "radio/utd.hpp"
#include "radio/world.hpp"

namespace wavetracer::test {

using Complex = std::complex<double>;
using CVector = glm::vec<3, Complex, glm::defaultp>;

inline CVector operator*(Complex c, const glm::dvec3& v) { return {c * v.x, c * v.y, c * v.z}; }
inline double length(const CVector& v) { return std::sqrt(std::norm(v.x) + std::norm(v.y) + std::norm(v.z)); }
inline Complex dot(const CVector& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline glm::dvec3 at_azimuth(double rho, double azimuth, double z) {
  return {rho * std::cos(azimuth), rho * std::sin(azimuth), z};
}

// The permittivity is that at 5.9 GHz.
inline WedgeFace concrete_face() { return {complex_permittivity(concrete(0.1), 5.9e9), 0.1}; }
inline WedgeFace glass_face() {
  return {complex_permittivity(Material{"glass", 6.31, 0, 0.0036, 1.3394, 0.1, 100, 0.01}, 5.9e9), 0.01};
}

inline double size(const Matrix2& m) {
  return std::sqrt(std::norm(m[0]) + std::norm(m[1]) + std::norm(m[2]) + std::norm(m[3]));
}

struct Corner {
  double exterior_rad;
  std::array<WedgeFace, 2> faces;
  double wavelength_m;
  bool transmits = false;

  WedgeFrame frame() const { return {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, exterior_rad}; }
  glm::dvec3 inward(size_t face) const { return at_azimuth(1, face == 0 ? 0 : exterior_rad, 0); }
  glm::dvec3 normal(size_t face) const {
    return face == 0 ? glm::dvec3{0, 1, 0} : glm::dvec3{std::sin(exterior_rad), -std::cos(exterior_rad), 0};
  }
  SlabCoefficients slab(size_t face, double cos_theta) const {
    if (std::isinf(faces[face].permittivity.real())) return {-1.0, 1.0, 0.0, 0.0};
    return slab_coefficients(faces[face].permittivity, std::min(cos_theta, 1.0), faces[face].thickness_m, wavelength_m);
  }

  // The field after a face, TE and TM taken apart.
  CVector meet(const CVector& e, size_t face, const glm::dvec3& k, bool passes) const {
    const glm::dvec3 n = normal(face), out = passes ? k : glm::reflect(k, n);
    const glm::dvec3 te = glm::normalize(glm::cross(k, n));
    const SlabCoefficients s = slab(face, std::abs(glm::dot(k, n)));
    return (passes ? s.transmission_te : s.reflection_te) * dot(e, te) * te +
           (passes ? s.transmission_tm : s.reflection_tm) * dot(e, glm::cross(te, k)) * glm::cross(te, out);
  }

  Complex spread(double length_m) const {
    return std::polar(1 / length_m, -2 * std::numbers::pi * length_m / wavelength_m);
  }
  // Returns the field of a source that sends the part of moment that is perpendicular to the direction of travel.
  static CVector sent(const glm::dvec3& moment, const glm::dvec3& k) {
    return Complex{1} * (moment - glm::dot(moment, k) * k);
  }

  // Finds where the straight line from a to b passes a face; returns false if it does not.
  bool passes(const glm::dvec3& a, const glm::dvec3& b, size_t face, double& part) const {
    const double from = glm::dot(a, normal(face)), to = glm::dot(b, normal(face));
    if (from * to >= 0) return false;
    part = from / (from - to);
    return glm::dot(a + part * (b - a), inward(face)) > 0;
  }

  // Direct, straight through both faces if it transmits, and all reflections up to `order`.
  CVector geometrical(const glm::dvec3& source, const glm::dvec3& receiver, const glm::dvec3& moment, int order) const {
    const glm::dvec3 k = glm::normalize(receiver - source);
    CVector direct = sent(moment, k), total{0};
    double part[2] = {};
    const bool met[2] = {passes(source, receiver, 0, part[0]),
                         exterior_rad < 2 * std::numbers::pi && passes(source, receiver, 1, part[1])};
    const size_t first = met[0] && met[1] ? part[1] < part[0] : met[1];
    if (met[first]) direct = transmits ? meet(direct, first, k, true) : CVector{0};
    if (met[0] && met[1]) direct = transmits ? meet(direct, 1 - first, k, true) : CVector{0};
    total += spread(glm::length(receiver - source)) * direct;
    for (size_t start : {0, 1}) {
      for (int count = 1; count <= order; ++count) total += reflected(source, receiver, moment, start, count);
    }
    return total;
  }

  CVector reflected(const glm::dvec3& source, const glm::dvec3& receiver, const glm::dvec3& moment, size_t start,
                    int count) const {
    std::vector<glm::dvec3> images{source};
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 n = normal((start + static_cast<size_t>(i)) % 2);
      images.push_back(images.back() - 2 * glm::dot(images.back(), n) * n);
    }
    std::vector<glm::dvec3> points{receiver};
    for (int i = count; i > 0; --i) {
      const size_t face = (start + static_cast<size_t>(i) - 1) % 2;
      double part;
      if (!passes(points.back(), images[static_cast<size_t>(i)], face, part)) return CVector{0};
      if (glm::dot(points.back(), normal(face)) <= 0) return CVector{0};
      points.push_back(points.back() + part * (images[static_cast<size_t>(i)] - points.back()));
    }
    const glm::dvec3 toward = source - points.back();
    if (glm::dot(toward, normal(start)) <= 0) return CVector{0};
    glm::dvec3 k = -glm::normalize(toward);
    CVector e = sent(moment, k);
    for (int i = 0; i < count; ++i) {
      const size_t face = (start + static_cast<size_t>(i)) % 2;
      e = meet(e, face, k, false);
      k = glm::reflect(k, normal(face));
    }
    return spread(glm::length(receiver - images.back())) * e;
  }

  CVector diffracted(const glm::dvec3& source, const glm::dvec3& receiver, const glm::dvec3& moment,
                     const LitSides& lit = {}) const {
    const double rho_in = std::hypot(source.x, source.y), rho_out = std::hypot(receiver.x, receiver.y);
    const glm::dvec3 q{0, 0, (source.z * rho_out + receiver.z * rho_in) / (rho_in + rho_out)};
    const double before = glm::length(q - source), after = glm::length(receiver - q), sine = rho_in / before;
    const glm::dvec3 k_in = (q - source) / before, k_out = (receiver - q) / after;
    const Diffraction d = diffract(frame(), faces, k_in, k_out, before * after * sine * sine / (before + after),
                                   wavelength_m, transmits, lit);
    const CVector e = sent(moment, k_in);
    const Complex a = dot(e, d.from[0]), b = dot(e, d.from[1]);
    const Complex spreading = std::polar(1 / (sine * std::sqrt(before * after * (before + after))),
                                         -2 * std::numbers::pi * (before + after) / wavelength_m);
    return spreading * (d.coefficient[0] * a + d.coefficient[1] * b) * d.to[0] +
           spreading * (d.coefficient[2] * a + d.coefficient[3] * b) * d.to[1];
  }
};

}  // namespace wavetracer::test
