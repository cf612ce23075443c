// SPDX-License-Identifier: Apache-2.0
// The functions of wavetracer.h about radars.
#include <string_view>
#include "library/column_view.hpp"
#include "library/handles.hpp"

namespace wavetracer::c_api {
namespace {

struct AxisName {
  const char* name;
  std::vector<double> RadarAxes::*values;
};

constexpr AxisName axis_names[] = {{"delay_s", &RadarAxes::delay_s},
                                   {"range_m", &RadarAxes::range_m},
                                   {"doppler_hz", &RadarAxes::doppler_hz},
                                   {"speed_m_s", &RadarAxes::speed_m_s}};

// Throws ConfigError if the frame has no row of radars of this number.
void check_radar_row(const char* function, const RadarColumns& radars, size_t row) {
  if (row >= radars.radar.size())
    throw ConfigError(std::string(function) + ": there is no row " + std::to_string(row) + " of radars, only " +
                      std::to_string(radars.radar.size()) + " counted from 0");
}

}  // namespace

RadarColumns radar_columns(const FrameResult& frame, std::vector<RadarAxes> axes) {
  RadarColumns out;
  out.axes = std::move(axes);
  out.detection_offset = {0};
  for (uint32_t radar = 0; radar < frame.radars.size(); ++radar)
    for (uint32_t i = 0; i < frame.radars[radar].size(); ++i) {
      const RadarRow& row = frame.radars[radar][i];
      out.radar.push_back(radar);
      out.tx.push_back(row.link.tx);
      out.rx.push_back(row.link.rx);
      out.left_out.push_back(row.left_out);
      out.place.push_back(i);
      for (const DetectionColumn& column : detection_columns) {
        std::vector<double>& to = out.detections.*column.values;
        const std::vector<double>& from = row.detections.*column.values;
        to.insert(to.end(), from.begin(), from.end());
      }
      out.detection_offset.push_back(out.detections.size());
    }
  return out;
}

}  // namespace wavetracer::c_api

using namespace wavetracer::c_api;
using wavetracer::ConfigError;

extern "C" {

size_t wavetracer_radar_count(const wavetracer_simulation* self) {
  return self ? self->simulation.config().radars.size() : 0;
}

const char* wavetracer_radar_name(const wavetracer_simulation* self, size_t index) {
  return index < wavetracer_radar_count(self) ? self->simulation.config().radars[index].name.c_str() : nullptr;
}

int wavetracer_frame_radar_cube(const wavetracer_frame* self, size_t row, size_t shape[4], wavetracer_column* cube,
                                wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_frame_radar_cube";
    const RadarColumns& radars = needed(self, here, "self").radars;
    needed(shape, here, "shape");
    needed(cube, here, "cube");
    check_radar_row(here, radars, row);
    const wavetracer::RadarAxes& axes = radars.axes[radars.radar[row]];
    shape[0] = axes.rx_antennas;
    shape[1] = axes.tx_antennas;
    shape[2] = axes.doppler_hz.size();
    shape[3] = axes.delay_s.size();
    const auto& values = self->result.radars[radars.radar[row]][radars.place[row]].cube;
    *cube = checked({values.data(), values.size() / shape[3], shape[3], WAVETRACER_COMPLEX128});
    return 1;
  });
}

int wavetracer_frame_radar_axis(const wavetracer_frame* self, size_t row, const char* name, wavetracer_column* axis,
                                wavetracer_error** error) {
  return guarded(error, 0, [&] {
    const char* const here = "wavetracer_frame_radar_axis";
    const RadarColumns& radars = needed(self, here, "self").radars;
    const std::string_view wanted = &needed(name, here, "name");
    needed(axis, here, "axis");
    check_radar_row(here, radars, row);
    for (const AxisName& known : axis_names) {
      if (wanted != known.name) continue;
      *axis = view(radars.axes[radars.radar[row]].*known.values);
      return 1;
    }
    throw ConfigError(std::string(here) + ": there is no axis \"" + std::string(wanted) +
                      "\": give delay_s, range_m, doppler_hz or speed_m_s");
  });
}

}  // extern "C"
