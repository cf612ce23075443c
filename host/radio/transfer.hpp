// SPDX-License-Identifier: Apache-2.0
// The transverse field of a wave along a path: a 2 x 2 matrix in a basis that travels with the wave.
// It is for plane waves at plane surfaces; spreading and antennas are left to the caller. The arithmetic is that of
// wavetracer/device/transfer.h.
#pragma once
#include <array>
#include <complex>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "radio/spherical.hpp"
#include "wavetracer/device/transfer.h"

namespace wavetracer {

// Rows come one after the other: {m00, m01, m10, m11}.
using Matrix2 = std::array<std::complex<double>, 4>;

inline Matrix2 matrix_of(const device::wt_matrix& m) {
  Matrix2 out;
  for (size_t i = 0; i < out.size(); ++i) out[i] = {m.m[i].x, m.m[i].y};
  return out;
}

class Transfer {
 public:
  // The wave leaves along a direction with this basis; columns of the matrix belong to (theta, phi) there.
  explicit Transfer(const SphericalBasis& departure)
      : state_(device::wt_transfer_from({departure.theta, departure.phi})) {}

  // The wave travels along k_in, meets a surface and continues along k_out: its field normal to the plane of incidence
  // (TE) and in that plane (TM) is multiplied by te and tm, with the signs of slab.hpp. All are unit vectors.
  void meet(const glm::dvec3& k_in, const glm::dvec3& k_out, const glm::dvec3& normal, std::complex<double> te,
            std::complex<double> tm) {
    device::wt_meet(&state_, k_in, k_out, normal, {te.real(), te.imag()}, {tm.real(), tm.imag()});
  }

  // The wave meets an edge or a rough surface: its field in components along from is multiplied by the matrix and goes
  // on in components along to, each an orthonormal pair normal to the direction of travel.
  void map(const std::array<glm::dvec3, 2>& from, const std::array<glm::dvec3, 2>& to, const Matrix2& matrix) {
    device::wt_matrix m;
    for (size_t i = 0; i < matrix.size(); ++i) m.m[i] = {matrix[i].real(), matrix[i].imag()};
    device::wt_map(&state_, {from[0], from[1]}, {to[0], to[1]}, m);
  }

  // The matrix with its rows along (theta, phi) of the arrival basis.
  Matrix2 seen_in(const SphericalBasis& arrival) const {
    return matrix_of(device::wt_seen_in(&state_, {arrival.theta, arrival.phi}));
  }

 private:
  device::wt_transfer state_;
};

}  // namespace wavetracer
