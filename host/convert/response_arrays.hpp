// SPDX-License-Identifier: Apache-2.0
// Returns the responses of a run as one padded array, for formats that only have rectangular arrays.
#pragma once
#include <array>
#include <optional>
#include <vector>
#include "convert/convert.hpp"
#include "results/saved_responses.hpp"

namespace wavetracer {

// (frame, rx, rx antenna, tx, tx antenna, time, frequency), as in sionna.rt.Paths.cfr(). Values are 0 where a link was
// not computed or has no path, or where an end has fewer antennas than the largest.
struct ResponseArray {
  size_t frames = 0, rx = 0, rx_antennas = 0, tx = 0, tx_antennas = 0, times = 0, frequencies = 0;
  std::vector<double> re, im;
  std::vector<double> frequencies_hz, times_s;
};

// Returns the responses of these frames, or nothing if the run has none. Throws InputError if they would take more than
// npz_limit_bytes. format: of the export, for the error message.
std::optional<ResponseArray> response_array(const SavedRun& run, const ExportOptions& options, const char* format);

}  // namespace wavetracer
