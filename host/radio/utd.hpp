// SPDX-License-Identifier: Apache-2.0
// The uniform theory of diffraction at a straight wedge: R. Kouyoumjian and P. Pathak, Proc. IEEE 62(11), 1974, with
// faces of any material. On Keller's cone the direction of travel keeps its angle with the edge.
#pragma once
#include <array>
#include <complex>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "radio/transfer.hpp"

namespace wavetracer {

// A wedge like Wedge (wavetracer/scene.hpp), in the world's axes: free space goes from azimuth 0 (face 0) to
// exterior_rad (face 1). The exterior angle is at least 0.05 pi; below pi it is a corner, in which waves are reflected
// several times.
struct WedgeFrame {
  glm::dvec3 along, face, normal;
  double exterior_rad;
};

struct WedgeFace {
  std::complex<double> permittivity;  // relative, as in slab_coefficients; infinite: a perfect conductor
  double thickness_m;
};

inline constexpr WedgeFace perfect_conductor{std::numeric_limits<double>::infinity(), 0};

// Says whether the direct ray and those reflected at one face reach the receiver, as far as the caller knows. This
// decides on which side of a shadow boundary the receiver is if the angles, within 1e-6 rad of it, cannot.
struct LitSides {
  std::optional<bool> direct;
  std::array<std::optional<bool>, 2> reflected;  // at face 0, at face 1
};

// A wave whose field at the edge is E, in components along from (beta', phi'), leaves it along k_out as
//   coefficient E / sin beta0 * sqrt(s' / (s (s' + s))) exp(-j k s)       (a plane wave: 1 / sqrt(s) instead)
// in components along to (beta, phi), where beta0 is the angle between edge and directions, s' and s are the lengths
// before and after the edge: the coefficient, in sqrt(m), is Kouyoumjian and Pathak's, signs included, times sin beta0.
// phi' is -along x k_in, phi is along x k_out (of unit length), beta' = phi' x k_in and beta = phi x k_out.
struct Diffraction {
  std::array<glm::dvec3, 2> from, to;
  Matrix2 coefficient;
};

// k_in, k_out: directions of travel, unit length; a direction outside of free space is treated as along the nearest
// face. distance_m: s s' sin^2 beta0 / (s + s'); for a plane wave, s sin^2 beta0. transmits: direct rays go on through
// the faces (one face where exterior_rad is 2 pi), and the diffracted wave replaces only the part that they lose there
// (W. Burnside and K. Burgener, IEEE Trans. AP 31(1), 1983). It is not used below pi, where nothing is in the way of a
// direct ray.
//
// The terms of a face are weighted by its reflection matrix, so that the total field is continuous at every shadow
// boundary. A face reflects the wave from the end that is nearer to it by azimuth (R. Luebbers, IEEE Trans. AP 32(1),
// 1984, with face 0 on the source's side), and the term of the direct wave whose boundary is behind the other face is
// weighted by both reflections (P. Holm, IEEE Trans. AP 48(8), 2000). So the coefficient is reciprocal, does not depend
// on which face is face 0, and vanishes at a face that reflects -1 and as the faces of a convex wedge become one plane.
//
// If one direction or both are within 1e-9 rad of a face, the reflected ray and the direct ray are one, which the
// caller counts once, and the coefficient is halved, as in Kouyoumjian and Pathak, for every polarisation. For
// directions along the edge, where no single point of it diffracts, the coefficient is 0.
Diffraction diffract(const WedgeFrame& wedge, const std::array<WedgeFace, 2>& faces, const glm::dvec3& k_in,
                     const glm::dvec3& k_out, double distance_m, double wavelength_m, bool transmits = false,
                     const LitSides& lit = {});

}  // namespace wavetracer
