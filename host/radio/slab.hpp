// SPDX-License-Identifier: Apache-2.0
// Reflection and transmission of a plane wave at a single-layer slab in free space (ITU-R P.2040-3, section 2.2.2).
// TE: the electric field is normal to the plane of incidence; TM: it lies in that plane.
#pragma once
#include <complex>
#include <span>

namespace wavetracer {

// Ratios of electric fields, reflection at the front face, transmission from front face to back face.
// Signs: at normal incidence reflection_tm = -reflection_te; a perfect conductor has reflection_te = -1 and
// reflection_tm = +1. The TM field is positive along (normal of the plane of incidence) x (direction of travel).
struct SlabCoefficients {
  std::complex<double> reflection_te, reflection_tm, transmission_te, transmission_tm;
};

// permittivity: relative, with a negative imaginary part for losses; its real part and its losses are not both zero.
// cos_theta: cosine of the angle between the direction of travel and the slab's normal, 0 (grazing) to 1. thickness_m:
// 0 or more; infinity is the half space, out of which nothing is transmitted. The result is finite for every such
// input: a metal, a resonant slab, exact grazing incidence.
SlabCoefficients slab_coefficients(std::complex<double> permittivity, double cos_theta, double thickness_m,
                                   double wavelength_m);

struct WallLayer {
  std::complex<double> permittivity;
  double thickness_m;
};

// The same of a wall of one layer or more, met on the side of the first one; transmission is that from the first to the
// last, which is the same the other way.
SlabCoefficients wall_coefficients(std::span<const WallLayer> layers, double cos_theta, double wavelength_m);

}  // namespace wavetracer
