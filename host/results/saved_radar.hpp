// SPDX-License-Identifier: Apache-2.0
// Reads the radar.h5 of a run, which [[radar]] or `python3 -m wavetracer.radar` makes: the range-Doppler maps and the
// spectrogram of one link of a radar.
// The file is not trusted: everything is checked before it is used.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

// Powers in dBm over two axes, in ascending order; -inf is none.
struct RadarMap {
  std::vector<double> rows;       // speeds in m/s, those that come nearer are positive; or times in s
  std::vector<double> columns;    // ranges in m; or speeds in m/s
  std::vector<double> power_dbm;  // row by row
};

// One of a file's radars and of its links.
struct RadarChoice {
  std::string radar;           // its name; empty: the first one
  std::optional<uint32_t> tx;  // the number of an end among those of its role; not given: that of the first link
  std::optional<uint32_t> rx;
};

class SavedRadar {
 public:
  // Throws InputError if the file was not written by wavetracer, or parts of it are missing or contradict each other,
  // and ConfigError for a radar or a link that it does not have.
  explicit SavedRadar(const std::filesystem::path& file, const RadarChoice& choice = {});
  ~SavedRadar();
  SavedRadar(SavedRadar&&) noexcept;

  const std::string& name() const;  // that of the radar
  uint32_t tx() const;              // numbers of the ends of the link
  uint32_t rx() const;
  const std::vector<uint32_t>& frames() const;  // those of the link: their numbers, ascending
  const std::vector<double>& times_s() const;   // the times of the frames
  // The speeds and ranges of a frame, by its place in frames(). Throws InputError.
  RadarMap range_doppler(size_t row) const;
  // The times and speeds of all frames; nothing if the file has no spectrogram. Throws InputError.
  std::optional<RadarMap> spectrogram() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Opens the radar.h5 beside the run's paths.h5; returns nothing if there is none.
std::optional<SavedRadar> saved_radar(const SavedRun& run, const RadarChoice& choice = {});

}  // namespace wavetracer
