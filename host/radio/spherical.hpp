// Directions, their angles and their spherical unit vectors.
// theta is the angle from +z, phi that from +x towards +y; at the poles, where phi is free, it is 0.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace wavetracer {

struct Angles {
  double theta_rad, phi_rad;  // 0 to pi, -pi to pi
};

// theta is V, phi is H; (theta, phi, direction) is orthonormal, and theta x phi = direction.
struct SphericalBasis {
  glm::dvec3 theta, phi;
};

inline Angles angles_of(const glm::dvec3& direction) {
  // + 0.0 turns a y of -0 into +0, so that phi on the negative x axis is pi and never -pi.
  const double rho = std::hypot(direction.x, direction.y);
  return {std::atan2(rho, direction.z), rho == 0 ? 0.0 : std::atan2(direction.y + 0.0, direction.x)};
}

// direction: of unit length.
inline SphericalBasis basis_of(const glm::dvec3& direction) {
  const double rho = std::hypot(direction.x, direction.y);
  const double cosine = rho == 0 ? 1.0 : direction.x / rho, sine = rho == 0 ? 0.0 : direction.y / rho;
  return {{direction.z * cosine, direction.z * sine, -rho}, {-sine, cosine, 0}};
}

}  // namespace wavetracer
