// The transverse field of a wave along a path: a 2 x 2 matrix in a basis that travels with the wave.
// Plane waves at plane surfaces; spreading and antennas are left to the caller.
#pragma once
#include <array>
#include <complex>

#include "radio/spherical.hpp"

namespace wavetracer {

// Row major: {m00, m01, m10, m11}.
using Matrix2 = std::array<std::complex<double>, 4>;

class Transfer {
 public:
  // The wave leaves along a direction with this basis; columns of the matrix belong to (theta, phi) there.
  explicit Transfer(const SphericalBasis& departure);

  // The wave travels along k_in, meets a surface and continues along k_out: its field normal to the plane of incidence
  // (TE) and in that plane (TM) is multiplied by te and tm, with the signs of slab.hpp. Unit vectors.
  void meet(const glm::dvec3& k_in, const glm::dvec3& k_out, const glm::dvec3& normal, std::complex<double> te,
            std::complex<double> tm);

  // The wave meets an edge or a rough surface: its field in components along from is multiplied by the matrix and goes
  // on in components along to, each an orthonormal pair normal to the direction of travel.
  void map(const std::array<glm::dvec3, 2>& from, const std::array<glm::dvec3, 2>& to, const Matrix2& matrix);

  // The matrix with its rows along (theta, phi) of the arrival basis.
  Matrix2 seen_in(const SphericalBasis& arrival) const;

 private:
  Matrix2 matrix_;
  glm::dvec3 first_, second_;  // the basis of the rows, normal to the direction of travel
};

}  // namespace wavetracer
