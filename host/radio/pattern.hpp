// Far-field patterns of antenna elements in their own frame: boresight +x, dipoles along z.
// A field is the amplitude over that of an isotropic antenna: its squared length is the gain, as a ratio.
#pragma once
#include <complex>
#include <functional>
#include <string>

#include "radio/spherical.hpp"

namespace wavetracer {

// Components along theta-hat (V) and phi-hat (H).
struct FieldPair {
  std::complex<double> theta, phi;
};

using Pattern = std::function<FieldPair(const Angles&)>;

FieldPair isotropic_pattern(const Angles&);         // gain 1 everywhere
FieldPair short_dipole_pattern(const Angles&);      // 1.5 sin^2 theta
FieldPair half_wave_dipole_pattern(const Angles&);  // 1.6409 broadside
FieldPair tr38901_pattern(const Angles&);           // 3GPP TR 38.901, Table 7.3-1: 8 dBi, at most 30 dB below that

// A pattern measured or computed elsewhere. The file is a CSV with the header
//   theta_deg,phi_deg,v_re,v_im,h_re,h_im
// and one row per direction, in any order: a regular grid over theta from 0 to 180 and phi around the full circle (the
// closing 360 may be there or not). Blank lines and lines that start with # are skipped. Between grid points the
// components are interpolated bilinearly. Throws InputError, naming file and line.
Pattern load_pattern(const std::string& file);

}  // namespace wavetracer
