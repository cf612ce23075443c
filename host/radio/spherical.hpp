// SPDX-License-Identifier: Apache-2.0
// Directions, their angles and their spherical unit vectors.
// theta is the angle from +z, phi that from +x towards +y; at the poles, where phi is free, phi is 0.
#pragma once
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "wavetracer/device/antenna.h"

namespace wavetracer {

struct Angles {
  double theta_rad, phi_rad;  // 0 to pi, -pi to pi
};

// theta is V, phi is H; (theta, phi, direction) is orthonormal, and theta x phi = direction.
struct SphericalBasis {
  glm::dvec3 theta, phi;
};

inline Angles angles_of(const glm::dvec3& direction) {
  const device::wt_angles angles = device::wt_angles_of(direction);
  return {angles.theta, angles.phi};
}

// direction: has unit length.
inline SphericalBasis basis_of(const glm::dvec3& direction) {
  const device::wt_basis basis = device::wt_spherical_basis(direction);
  return {basis.first, basis.second};
}

}  // namespace wavetracer
