// SPDX-License-Identifier: Apache-2.0
// The beat signal of a link: chirps that are sent, mixed with what arrives along its paths (docs/radar.md).
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wavetracer/arrays.hpp"
#include "wavetracer/frame_result.hpp"
#include "wavetracer/radar_config.hpp"

namespace wavetracer {

// Complex samples in roots of watts, [rx antenna][tx antenna][chirp][sample]; antennas are port * elements + element.
struct BeatSignal {
  size_t rx_antennas, tx_antennas, chirps, samples;
  std::vector<double> re, im;
  uint32_t left_out = 0;  // paths that are too long for the waveform

  size_t row(size_t rx, size_t tx, size_t chirp) const { return ((rx * tx_antennas + tx) * chirps + chirp) * samples; }
};

// The received chirp, mixed with the one that is sent, has the phase -2 pi f tau + pi slope tau^2, where f is the
// frequency that is sent at that instant and tau the delay then: delays change at the rate of the Doppler shifts, which
// are those of the carrier. Amplitudes stay those of the frame. link: one of the frame. Without noise. It uses all
// cores; the result does not depend on their number.
BeatSignal beat_signal(const ElementModel& model, const FrameResult& frame, Link link, const RadarConfig& radar,
                       double power_dbm);

// Adds the noise of a receiver at 290 K with radar.noise_figure_db, if that is given. It depends on radar.seed, the
// name of the radar, the number and the time of the frame, and the link alone: radars of one link have different noise,
// and so have instants between live frames, which have the number of the frame that follows.
void add_noise(BeatSignal& signal, const RadarConfig& radar, uint32_t frame, double time_s, Link link);

}  // namespace wavetracer
