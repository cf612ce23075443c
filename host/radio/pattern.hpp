// SPDX-License-Identifier: Apache-2.0
// Far-field patterns of antenna elements in their own frame: boresight +x, dipoles along z.
// A field is the amplitude relative to that of an isotropic antenna: its squared length is the gain, as a ratio. The
// closed forms are in wavetracer/device/antenna.h; all except that of TR 38.901 are patterns of lossless antennas.
#pragma once
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

namespace wavetracer {

// The components along theta-hat (V) and phi-hat (H).
struct FieldPair {
  std::complex<double> theta, phi;
};

// A pattern on a regular grid; between its points the components are interpolated bilinearly.
struct PatternGrid {
  uint32_t rows = 0, columns = 0;                      // theta, phi
  double theta_step = 0, phi_step = 0, first_phi = 0;  // micro-degrees
  std::vector<double> samples;                         // row by row: theta and phi components, real and imaginary
};

// Reads a pattern that was measured or computed elsewhere. The file is a CSV with the header
//   theta_deg,phi_deg,v_re,v_im,h_re,h_im
// and one row per direction, in any order: a regular grid over theta from 0 to 180 and phi around the full circle (the
// closing 360 may be present or not). Blank lines and lines that start with # are skipped. Throws InputError, naming
// file and line.
PatternGrid load_pattern(const std::string& file);

}  // namespace wavetracer
