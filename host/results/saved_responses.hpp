// SPDX-License-Identifier: Apache-2.0
// Reads the responses.h5 of a run, one frame at a time ([response]).
// The file is not trusted: everything is checked before it is used.
#pragma once
#include <complex>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

// The channel of a link as [time][rx antenna][tx antenna][frequency]; antenna i of an end is element i / ports, port i
// % ports.
struct SavedResponse {
  Link link{0, 0};
  std::vector<std::complex<double>> h;
};

class SavedResponses {
 public:
  // Throws InputError if the file was not written by wavetracer, or parts of it are missing or contradict each other.
  explicit SavedResponses(const std::filesystem::path& file);
  ~SavedResponses();
  SavedResponses(SavedResponses&&) noexcept;

  const std::vector<double>& frequencies_hz() const;        // absolute frequencies
  const std::vector<double>& times_s() const;               // relative to the time of the frame
  const std::vector<uint32_t>& tx_antennas() const;         // elements x ports, for each transmitter
  const std::vector<uint32_t>& rx_antennas() const;         // for each receiver
  std::vector<SavedResponse> frame(uint32_t number) const;  // sorted by link; throws InputError

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Opens the responses.h5 beside the run's paths.h5; returns nothing if there is none. Throws InputError if it has other
// ends than the run.
std::optional<SavedResponses> saved_responses(const SavedRun& run);

}  // namespace wavetracer
