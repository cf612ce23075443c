// SPDX-License-Identifier: Apache-2.0
// The table [[radar]]: radars of linear chirps, whose echoes are paths from transmitters to receivers (docs/radar.md).
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "wavetracer/choice.hpp"

namespace wavetracer {

// The pairs of ends that are radars. monostatic: both are on one vehicle, or both are fixed; bistatic: all others, and
// fixed ones.
using RadarKind = Choice<"monostatic", "bistatic">;
using RadarWindow = Choice<"hann", "hamming", "blackman", "none">;

struct RadarConfig {  // [[radar]]
  std::string name;
  RadarKind kind = "monostatic";
  std::string transmitter = "*", receiver = "*";  // names of ends, * and ? as in shells
  double bandwidth_hz = 1e9;                      // rise within a chirp, about the carrier as its middle
  double chirp_s = 20e-6;
  std::optional<double> interval_s = {};       // from a chirp to the next; not given: chirp_s
  uint32_t chirps = 128;                       // each antenna sends so many
  uint32_t samples = 256;                      // complex samples of a chirp
  bool turns = false;                          // transmitting antennas send in turns; else codes tell them apart
  std::optional<double> power_dbm = {};        // not given: radio.transmit_power_dbm, or else default_power_dbm
  std::optional<double> noise_figure_db = {};  // not given: no noise
  std::optional<uint64_t> seed = {};           // draws the noise; not given: 0
  RadarWindow range_window = "hann", doppler_window = "hann";
  bool direct = true;  // with the direct path from the transmitter to the receiver
  double false_alarm = 1e-6;
  uint32_t guard = 2, training = 6;  // cells to each side of a cell
  bool cube = true;                  // write the cube; else its map and its detections alone

  static constexpr double default_power_dbm = 10;
  double spacing_s() const { return interval_s.value_or(chirp_s); }
  // The time from a chirp of an antenna to its next one.
  double repetition_s(uint32_t tx_antennas) const { return spacing_s() * (turns ? tx_antennas : 1); }
  // The receiver's filter keeps paths that are shorter.
  double longest_delay_s() const { return samples / bandwidth_hz; }
};

}  // namespace wavetracer
