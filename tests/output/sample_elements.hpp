// SPDX-License-Identifier: Apache-2.0
// Invented values between elements in frames of the sample run: simple functions of frame, link and row.
#pragma once
#include <span>
#include <vector>
#include "output/sample_run.hpp"
#include "wavetracer/arrays.hpp"

namespace wavetracer {

// The transmitter 0 has two elements; responses of two subcarriers at two times; two carriers; a radar with cubes on
// its links, and one without.
inline void ask_for_elements(Config& config) {
  config.arrays.resize(1);
  config.arrays[0].name = "pair";
  config.arrays[0].columns = 2;
  config.arrays[0].codebook = "dft";
  config.transmitters[0].array = "pair";
  config.response = {20e6, 2, 2, 1e-3};
  config.radio.frequencies_hz = {config.radio.frequency_hz, 2 * config.radio.frequency_hz};
  RadarConfig radar;
  radar.name = "front";
  radar.chirps = 4;
  radar.samples = 3;
  config.radars = {radar, radar};
  config.radars[1].name = "rear";
  config.radars[1].cube = false;
}

// A radar's row of a link of transmitter 0, with a detection if the receiver is the first.
inline RadarRow sample_radar_row(const FrameResult& frame, Link link, bool with_cube) {
  RadarRow out{link, frame.frame % 3, {}, {}, {}, {}};
  for (uint32_t i = 0; i < 12; ++i) out.power_dbm.push_back(-90.0 - i - frame.frame);
  for (uint32_t i = 0; i < 4; ++i) out.spectrum_dbm.push_back(-80.0 - i - link.rx);
  for (uint32_t i = 0; with_cube && i < 24; ++i) out.cube.emplace_back(0.5 * i, frame.frame);
  if (link.rx == 0) out.detections = {{1e-7}, {500.0 + frame.frame}, {15}, {1}, {-90}, {-101}, {0.25}, {-0.5}};
  return out;
}

// Rows of a link: times, receiving and transmitting antennas.
inline uint64_t sample_rows(const Config& config, const Link& link) {
  const auto antennas = [](const RadioEnd& end) {
    const bool two = end.polarization == "VH" || end.polarization == "cross";
    return (end.array.empty() ? 1u : 2u) * (two ? 2u : 1u);
  };
  return uint64_t{2} * antennas(config.transmitters[link.tx]) * antennas(config.receivers[link.rx]);
}

inline void add_elements(const Config& config, std::vector<FrameResult>& frames) {
  for (FrameResult& frame : frames) {
    Responses& responses = frame.responses;
    responses = {2, 4, {0}, {}};
    frame.beams = {};
    for (const Link& link : frame.world.links) {
      responses.row_offset.push_back(responses.row_offset.back() + sample_rows(config, link));
      for (uint32_t beam = 0; link.tx == 0 && beam < 2; ++beam) {
        frame.beams.tx.push_back(link.tx);
        frame.beams.rx.push_back(link.rx);
        frame.beams.tx_beam.push_back(beam);
        frame.beams.rx_beam.push_back(0);
        frame.beams.gain_db.push_back(-80.0 - link.rx + beam * (frame.frame % 2 == 0 ? 1.5 : -1.5));
      }
    }
    for (uint64_t i = 0; i < 4 * responses.row_offset.back(); ++i)
      responses.h.emplace_back(static_cast<float>(frame.frame) + 0.25f * static_cast<float>(i), -0.5f);
    frame.radars.assign(2, {});
    for (const Link& link : frame.world.links)
      for (size_t i = 0; link.tx == 0 && i < 2; ++i)
        frame.radars[i].push_back(sample_radar_row(frame, link, config.radars[i].cube));
    frame.carriers = {{2 * config.radio.frequency_hz, frame.paths.a, frame.paths.gain_db, frame.paths.doppler_hz}};
    for (auto& a : frame.carriers[0].a) a[0] *= 0.5;
    for (double& shift : frame.carriers[0].doppler_hz) shift *= 2;
  }
}

// A run that asks for them, and its frames with them.
struct SampleElements : SampleRun {
  std::vector<FrameResult> filled;
  SampleElements() {
    ask_for_elements(config);
    filled = frames();
    add_elements(config, filled);
  }
};

}  // namespace wavetracer
