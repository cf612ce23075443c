// SPDX-License-Identifier: Apache-2.0
// The steps in their order; each is a file of this folder.
#include "radar/radar_rows.hpp"

#include <tbb/parallel_for.h>

#include "radar/arrival_angles.hpp"
#include "radar/beat_signal.hpp"
#include "radar/detections.hpp"
#include "radar/radar_cube.hpp"

namespace wavetracer {
namespace {

std::vector<double> spectrum_of(const std::vector<double>& map_w, size_t delays) {
  std::vector<double> out;
  for (size_t first = 0; first < map_w.size(); first += delays) {
    double sum = 0;
    for (size_t s = 0; s < delays; ++s) sum += map_w[first + s];
    out.push_back(dbm_of(sum));
  }
  return out;
}

}  // namespace

RadarRow radar_row(const ElementModel& model, const Config& config, const FrameResult& frame, Link link,
                   const RadarConfig& radar, const RadarAxes& axes, bool with_cube) {
  BeatSignal signal = beat_signal(model, frame, link, radar, radar_power_dbm(radar, config.radio));
  add_noise(signal, radar, frame.frame, frame.world.time_s, link);
  RadarRow out{link, signal.left_out, radar_cube(signal, radar, axes), {}, {}, {}};
  const size_t pairs = signal.rx_antennas * signal.tx_antennas, cells = out.cube.size() / pairs;
  const std::vector<double> map_w = radar_map_w(out.cube, pairs);
  const std::vector<DetectedCell> found = detected_cells(map_w, radar);
  out.detections = detections_of(found, map_w, axes, config.radio.frequency_hz);
  out.detections.azimuth_rad.resize(found.size());
  out.detections.elevation_rad.resize(found.size());
  const LookingArray array(config, frame, link, radar);
  tbb::parallel_for(size_t{0}, found.size(), [&](size_t i) {
    std::vector<std::complex<double>> values(pairs);
    for (size_t pair = 0; pair < pairs; ++pair)
      values[pair] = out.cube[pair * cells + found[i].shift * axes.delay_s.size() + found[i].delay];
    const ArrivalAngles angles = array.angles(values);
    out.detections.azimuth_rad[i] = angles.azimuth_rad;
    out.detections.elevation_rad[i] = angles.elevation_rad;
  });
  out.spectrum_dbm = spectrum_of(map_w, axes.delay_s.size());
  out.power_dbm.reserve(cells);
  for (const double power_w : map_w) out.power_dbm.push_back(dbm_of(power_w));
  if (!with_cube) out.cube = {};
  return out;
}

}  // namespace wavetracer
