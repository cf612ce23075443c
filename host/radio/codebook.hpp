// SPDX-License-Identifier: Apache-2.0
// Beams of arrays: the weights with which the signals of elements are added up. The powers of a beam's weights add up
// to 1. A beam points in the same direction when it sends and when it receives: the channel between two beams is the
// sum over elements of w_rx h w_tx, without a conjugate.
#pragma once
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer {

struct Codebook {
  uint32_t beams = 0, elements = 0;
  std::vector<std::complex<double>> weights;  // [beam][element]
};

// Beam column * rows + row of a panel, column < columns and row < rows, points to where the wave arrives with cos(angle
// to +y) = column / (columns d_y) and cos(angle to +z) = row / (rows d_z), spacings d in wavelengths. Where a cosine is
// beyond the visible range, whole periods 1 / d are subtracted.
Codebook dft_codebook(uint32_t rows, uint32_t columns);

// Reads a CSV file with the header beam,element,re,im and a row per weight, in any order; blank lines and lines that
// start with # are skipped. Throws InputError that names file and line.
Codebook load_codebook(const std::string& file, uint32_t elements);

// The codebook of the end's array; it has no beams if the array has none. Throws ConfigError or InputError.
Codebook codebook_of(const Config& config, const RadioEnd& end);

// Does any array have a codebook?
bool has_beams(const Config& config);

}  // namespace wavetracer
