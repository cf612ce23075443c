// SPDX-License-Identifier: Apache-2.0
// Each radar has a group of its name, with a row for each link in each frame. Maps have double precision, cubes single.
#include "output/radar_h5.hpp"
#include <fmt/format.h>
#include <span>
#include "radar/radar_cube.hpp"
#include "wavetracer/arrays.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

void write_axis(hdf5::File& file, const std::string& path, const char* unit, const char* description,
                const std::vector<double>& values) {
  hdf5::Rows<double>(file, path, {unit, description}, {values.size()}).append(values);
}

void write_radar_attributes(hid_t group, const RadarConfig& radar, const RadioConfig& radio) {
  const auto number = [&](const char* name, double value) {
    hdf5::write_attribute(group, name, std::span<const double>(&value, 1));
  };
  hdf5::write_attribute(group, "kind", std::string(radar.kind.word()));
  number("frequency_hz", radio.frequency_hz);
  number("bandwidth_hz", radar.bandwidth_hz);
  number("chirp_s", radar.chirp_s);
  number("interval_s", radar.spacing_s());
  number("power_dbm", radar_power_dbm(radar, radio));
  number("false_alarm", radar.false_alarm);
  if (radar.noise_figure_db) number("noise_figure_db", *radar.noise_figure_db);
  hdf5::write_attribute(group, "turns", uint32_t{radar.turns});
  hdf5::write_attribute(group, "range_window", std::string(radar.range_window.word()));
  hdf5::write_attribute(group, "doppler_window", std::string(radar.doppler_window.word()));
}

// Columns of a table, appended one after the other.
class RadarColumns {
 public:
  RadarColumns(FrameTables& tables, const std::string& group, const char* description) : tables_(tables) {
    tables.group(group, description);
  }
  template <class T>
  void operator()(const char* name, const char* unit, const char* description, const std::vector<T>& values,
                  const std::vector<hsize_t>& row_shape = {}) {
    tables_.append<T>(name, {unit, description}, std::span<const T>(values), row_shape);
  }

 private:
  FrameTables& tables_;
};

// Values of all rows of a radar, one after the other.
template <class T, class Get>
std::vector<T> of_rows(const std::vector<RadarRow>& rows, const Get& get) {
  std::vector<T> out;
  for (const RadarRow& row : rows) get(row, out);
  return out;
}

// The elements of an end in a frame from its position, in the axes of the scene, once for each port.
void add_antennas(const Config& config, const RadioEnd& end, const EndState& state, std::vector<double>& out) {
  const std::vector<glm::dvec3> elements = element_positions_m(config, end);
  for (uint32_t port = 0; port < ports_of(end.polarization); ++port)
    for (const glm::dvec3& element : elements) {
      const glm::dvec3 p = state.rotation * element;
      out.insert(out.end(), {p.x, p.y, p.z});
    }
}

void append_rows_table(FrameTables& tables, const std::string& group, const RadarRows& rows, const RadarAxes& axes,
                       const Config& config, const FrameResult& frame) {
  const auto column = [&](auto get) {
    return of_rows<uint32_t>(rows, [&](const RadarRow& row, auto& out) { out.push_back(get(row)); });
  };
  RadarColumns add(tables, group + "/frames", "one row per frame and link of the radar, sorted by frame, tx, rx");
  add("frame", "1", "number of the frame, see /frames/frame of paths.h5",
      std::vector<uint32_t>(rows.size(), frame.frame));
  add("time_s", "s", "time of the frame", std::vector<double>(rows.size(), frame.world.time_s));
  add("tx", "1", "row of /transmitters of paths.h5", column([](const RadarRow& row) { return row.link.tx; }));
  add("rx", "1", "row of /receivers of paths.h5", column([](const RadarRow& row) { return row.link.rx; }));
  add("left_out", "1", "paths that are too long for the waveform",
      column([](const RadarRow& row) { return row.left_out; }));
  const char* const offset =
      "of each antenna from the position of its end, in the axes of the scene; shape (row, antenna, 3)";
  add("rx_offset_m", "m", offset,
      of_rows<double>(rows,
                      [&](const RadarRow& row, auto& out) {
                        add_antennas(config, config.receivers[row.link.rx], frame.world.receivers[row.link.rx], out);
                      }),
      {axes.rx_antennas, 3});
  add("tx_offset_m", "m", offset,
      of_rows<double>(rows,
                      [&](const RadarRow& row, auto& out) {
                        add_antennas(config, config.transmitters[row.link.tx], frame.world.transmitters[row.link.tx],
                                     out);
                      }),
      {axes.tx_antennas, 3});
}

void append_maps(FrameTables& tables, const std::string& group, const RadarRows& rows, const RadarAxes& axes,
                 double time_s) {
  const hsize_t shifts = axes.doppler_hz.size(), delays = axes.delay_s.size();
  RadarColumns maps(tables, group + "/maps", "the mean power over antennas, in the order of frames");
  maps("power_dbm", "dBm", "power; shape (row, Doppler shift, delay); -inf: none",
       of_rows<double>(rows, [](const RadarRow& row,
                                auto& out) { out.insert(out.end(), row.power_dbm.begin(), row.power_dbm.end()); }),
       {shifts, delays});
  RadarColumns spectra(tables, group + "/spectrogram", "the Doppler spectrum of each row of frames, over all delays");
  spectra("time_s", "s", "time of the frame", std::vector<double>(rows.size(), time_s));
  spectra(
      "power_dbm", "dBm", "power; shape (row, Doppler shift); -inf: none",
      of_rows<double>(rows, [](const RadarRow& row,
                               auto& out) { out.insert(out.end(), row.spectrum_dbm.begin(), row.spectrum_dbm.end()); }),
      {shifts});
}

void append_cubes(FrameTables& tables, const std::string& group, const RadarRows& rows, const RadarAxes& axes) {
  const std::vector<hsize_t> shape{axes.rx_antennas, axes.tx_antennas, axes.doppler_hz.size(), axes.delay_s.size()};
  const auto part = [&](auto get) {
    size_t cells = 0;
    for (const RadarRow& row : rows) cells += row.cube.size();
    std::vector<float> out;
    out.reserve(cells);
    for (const RadarRow& row : rows)
      for (const std::complex<double>& value : row.cube) out.push_back(static_cast<float>(get(value)));
    return out;
  };
  RadarColumns add(tables, group + "/cube", "range-Doppler cubes of all antennas, in the order of frames");
  add("re", "sqrt(W)", "real part; shape (row, rx antenna, tx antenna, Doppler shift, delay)",
      part([](const std::complex<double>& value) { return value.real(); }), shape);
  add("im", "sqrt(W)", "imaginary part; shape (row, rx antenna, tx antenna, Doppler shift, delay)",
      part([](const std::complex<double>& value) { return value.imag(); }), shape);
}

void append_detections(FrameTables& tables, const std::string& group, const RadarRows& rows, uint32_t frame) {
  const auto column = [&](auto get) {
    return of_rows<uint32_t>(
        rows, [&](const RadarRow& row, auto& out) { out.insert(out.end(), row.detections.size(), get(row)); });
  };
  RadarColumns add(tables, group + "/detections", "cells above the threshold, of each row of frames by falling power");
  add("frame", "1", "number of the frame", column([&](const RadarRow&) { return frame; }));
  add("tx", "1", "row of /transmitters of paths.h5", column([](const RadarRow& row) { return row.link.tx; }));
  add("rx", "1", "row of /receivers of paths.h5", column([](const RadarRow& row) { return row.link.rx; }));
  for (const auto& [name, unit, description, values] : detection_columns)
    add(name, unit, description, of_rows<double>(rows, [&, of = values](const RadarRow& row, auto& out) {
          const std::vector<double>& found = row.detections.*of;
          out.insert(out.end(), found.begin(), found.end());
        }));
}

}  // namespace

std::vector<std::string> growing_radar_groups(const std::vector<RadarConfig>& radars) {
  std::vector<std::string> out;
  for (const RadarConfig& radar : radars) {
    for (const char* group : {"/frames", "/maps", "/spectrogram", "/detections"})
      out.push_back("/" + radar.name + group);
    if (radar.cube) out.push_back("/" + radar.name + "/cube");
  }
  return out;
}

void encode_radar_head_h5(const Run& run, hdf5::File& file) {
  const auto text = [&](const char* name, const std::string& value) { hdf5::write_attribute(file.id(), name, value); };
  text("format", "wavetracer radar");
  hdf5::write_attribute(file.id(), "format_version", uint32_t{2});
  text("version", run.summary.version);
  text("config_file", run.config.file);
  text("config", run.config.text);
  std::string names;
  for (const RadarConfig& radar : run.config.radars) names += (names.empty() ? "" : ",") + radar.name;
  text("radars", names);
  for (size_t i = 0; i < run.config.radars.size(); ++i) {
    const RadarConfig& radar = run.config.radars[i];
    const std::string group = "/" + radar.name;
    const hdf5::Id id = file.make_group(group, "a radar: its axes, and tables of its links in all frames");
    write_radar_attributes(id, radar, run.config.radio);
    const RadarAxes& axes = run.radars.at(i);
    write_axis(file, group + "/delay_s", "s", "delays of maps and cubes", axes.delay_s);
    write_axis(file, group + "/range_m", "m", "half the lengths of paths of these delays", axes.range_m);
    write_axis(file, group + "/doppler_hz", "Hz", "Doppler shifts of maps, cubes and spectra", axes.doppler_hz);
    write_axis(file, group + "/spectrogram_doppler_hz", "Hz", "Doppler shifts of the spectrogram", axes.doppler_hz);
    write_axis(file, group + "/speed_m_s", "m/s", "speeds at which a target of these shifts comes nearer",
               axes.speed_m_s);
  }
}

void append_radar_h5(const Run& run, const FrameResult& frame, FrameTables& tables) {
  if (frame.radars.size() != run.config.radars.size())
    throw RuntimeError(
        fmt::format("frame {} has {} radars, and the configuration has {}; this is a fault of "
                    "wavetracer, report it",
                    frame.frame, frame.radars.size(), run.config.radars.size()));
  for (size_t i = 0; i < frame.radars.size(); ++i) {
    const std::string group = "/" + run.config.radars[i].name;
    const RadarRows& rows = frame.radars[i];
    append_rows_table(tables, group, rows, run.radars.at(i), run.config, frame);
    append_maps(tables, group, rows, run.radars.at(i), frame.world.time_s);
    append_detections(tables, group, rows, frame.frame);
    if (run.config.radars[i].cube) append_cubes(tables, group, rows, run.radars.at(i));
  }
}

}  // namespace wavetracer
