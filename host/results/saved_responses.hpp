// The responses.h5 of a run, read back one frame at a time ([response]).
// Everything in the file is checked before it is used; an HDF5 file is input like any other.
#pragma once
#include <complex>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

// The channel of a link, [time][rx antenna][tx antenna][frequency]; antenna i of an end is element i / ports, port i %
// ports.
struct SavedResponse {
  Link link{0, 0};
  std::vector<std::complex<double>> h;
};

class SavedResponses {
 public:
  // Throws InputError where the file is none of wavetracer's, or parts of it are missing or contradict each other.
  explicit SavedResponses(const std::filesystem::path& file);
  ~SavedResponses();
  SavedResponses(SavedResponses&&) noexcept;

  const std::vector<double>& frequencies_hz() const;        // absolute
  const std::vector<double>& times_s() const;               // since that of the frame
  const std::vector<uint32_t>& tx_antennas() const;         // elements x ports, of each transmitter
  const std::vector<uint32_t>& rx_antennas() const;         // of each receiver
  std::vector<SavedResponse> frame(uint32_t number) const;  // of its links, sorted; throws InputError

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Of the responses.h5 beside the run's paths.h5; nothing where there is none. Throws InputError where it has other ends
// than the run.
std::optional<SavedResponses> saved_responses(const SavedRun& run);

}  // namespace wavetracer
