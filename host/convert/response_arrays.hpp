// Responses of a run as one padded array, for formats that have rectangular arrays only.
#pragma once
#include <array>
#include <optional>
#include <vector>
#include "convert/convert.hpp"
#include "results/saved_responses.hpp"

namespace wavetracer {

// (frame, rx, rx antenna, tx, tx antenna, time, frequency), as sionna.rt.Paths.cfr() has it; 0 where a link was not
// asked for, has no path, or an end has fewer antennas than the largest.
struct ResponseArray {
  size_t frames = 0, rx = 0, rx_antennas = 0, tx = 0, tx_antennas = 0, times = 0, frequencies = 0;
  std::vector<double> re, im;
  std::vector<double> frequencies_hz, times_s;
};

// Of these frames; nothing where the run has no responses. Throws InputError where it would take more than
// npz_limit_bytes. format: of the export, for the error.
std::optional<ResponseArray> response_array(const SavedRun& run, const ExportOptions& options, const char* format);

}  // namespace wavetracer
