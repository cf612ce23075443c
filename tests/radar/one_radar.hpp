// SPDX-License-Identifier: Apache-2.0
// A radar whose transmitter and receiver see each other, or a mirror, at 77 GHz.
#pragma once
#include "radar/radar_cube.hpp"
#include "radar/radar_rows.hpp"
#include "radio/array_world.hpp"

namespace wavetracer::test {

constexpr double radar_carrier_hz = 77e9;

inline RadarConfig front_radar() {
  RadarConfig out;
  out.name = "front";
  out.kind = "bistatic";
  out.bandwidth_hz = 1e9;
  out.chirp_s = 20e-6;
  out.interval_s = 25e-6;
  out.chirps = 64;
  out.samples = 128;
  out.power_dbm = 30;
  return out;
}

struct RadarWorld : ArrayWorld {
  RadarConfig radar = front_radar();

  RadarWorld(const ArrayConfig& sent, const ArrayConfig& heard, const glm::dvec3& tx, const glm::dvec3& rx,
             const std::array<double, 3>& rx_orientation_deg = {0, 0, 0})
      : ArrayWorld(sent, heard, tx, rx, {0, 0, 0}, rx_orientation_deg) {
    config.radio.frequency_hz = radar_carrier_hz;
  }

  RadarAxes axes() const {
    const auto count = [&](const RadioEnd& end) {
      return static_cast<uint32_t>(element_positions_m(config, end).size()) * ports_of(end.polarization);
    };
    return radar_axes(radar, count(config.receivers[0]), count(config.transmitters[0]), radar_carrier_hz);
  }
  RadarRow row(const FrameResult& frame) const {
    return radar_row(ElementModel(config, scene), config, frame, {0, 0}, radar, axes(), true);
  }
};

// The cell of a map with the most power: its Doppler shift and its delay.
inline std::pair<size_t, size_t> highest(const RadarRow& row, size_t delays) {
  const auto at = static_cast<size_t>(std::ranges::max_element(row.power_dbm) - row.power_dbm.begin());
  return {at / delays, at % delays};
}

}  // namespace wavetracer::test
