// SPDX-License-Identifier: Apache-2.0
// Range-Doppler cubes of beat signals, and the axes of their maps.
#pragma once
#include <complex>
#include <vector>

#include "radar/beat_signal.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/radar.hpp"

namespace wavetracer {

// The power that each antenna sends: that of the radar, or else radio.transmit_power_dbm, or else the default.
double radar_power_dbm(const RadarConfig& radar, const RadioConfig& radio);

RadarAxes radar_axes(const RadarConfig& radar, uint32_t rx_antennas, uint32_t tx_antennas, double carrier_hz);

// Values in roots of watts, [rx antenna][tx antenna][Doppler shift][delay]. An echo has its amplitude in the cell of
// its delay and Doppler shift: sums of windows are 1. Shifts are those of axes, ascending. It uses all cores; the
// result does not depend on their number.
std::vector<std::complex<double>> radar_cube(const BeatSignal& signal, const RadarConfig& radar, const RadarAxes& axes);

// The mean power over `pairs` pairs of antennas, W, [Doppler shift][delay].
std::vector<double> radar_map_w(const std::vector<std::complex<double>>& cube, size_t pairs);

}  // namespace wavetracer
