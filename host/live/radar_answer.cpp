// SPDX-License-Identifier: Apache-2.0
// Numbers of a cube are one list, in the order of its axes.
#include "live/radar_answer.hpp"

#include <utility>

namespace wavetracer::live {
namespace {

void write_numbers(Line& line, const char* name, const std::vector<double>& values) {
  line.key(name);
  line.list(0, values.size(), [&](size_t i) { line.number(values[i]); });
}

void write_cube(Line& line, const RadarRow& row, const RadarAxes& axes) {
  const auto part = [&](const char* name, auto get) {
    line.key(name);
    line.list(0, row.cube.size(), [&](size_t i) { line.number(get(row.cube[i])); });
  };
  write_numbers(line, "antennas", {static_cast<double>(axes.rx_antennas), static_cast<double>(axes.tx_antennas)});
  write_numbers(line, "delay_s", axes.delay_s);
  write_numbers(line, "doppler_hz", axes.doppler_hz);
  part("cube_re", [](const std::complex<double>& value) { return value.real(); });
  part("cube_im", [](const std::complex<double>& value) { return value.imag(); });
}

void write_row(Line& line, const LiveFrame& frame, const RadarAnswer& radars, size_t radar, const RadarRow& row) {
  line.raw("{\"radar\":");
  line.text(radars.config.radars[radar].name);
  line.key("tx");
  line.text(frame.transmitters[row.link.tx]);
  line.key("rx");
  line.text(frame.receivers[row.link.rx]);
  write_numbers(line, "frequency_hz", {radars.config.radio.frequency_hz});
  write_numbers(line, "left_out", {static_cast<double>(row.left_out)});
  line.key("detections");
  bool first = true;
  for (const DetectionColumn& column : detection_columns) {
    line.raw(std::exchange(first, false) ? "{" : ",");
    line.text(column.name);
    line.raw(":");
    const std::vector<double>& values = row.detections.*column.values;
    line.list(0, values.size(), [&](size_t i) { line.number(values[i]); });
  }
  line.raw("}");
  if (radars.cubes) write_cube(line, row, radars.axes[radar]);
  line.raw("}");
}

}  // namespace

void write_radars(Line& line, const LiveFrame& frame, const RadarAnswer& radars) {
  line.key("radars");
  line.raw("[");
  bool first = true;
  for (size_t radar = 0; radar < radars.rows.size(); ++radar)
    for (const RadarRow& row : radars.rows[radar]) {
      if (!std::exchange(first, false)) line.raw(",");
      write_row(line, frame, radars, radar, row);
    }
  line.raw("]");
}

}  // namespace wavetracer::live
