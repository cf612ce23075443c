// SPDX-License-Identifier: Apache-2.0
// Columns are sent as they are in memory, without conversion. The machine must be little-endian, as the tags say.
#include "live/channel_columns.hpp"

#include <bit>
#include <span>
#include <string_view>

#include "wavetracer/simulation.hpp"

namespace wavetracer::live {
namespace {

static_assert(std::endian::native == std::endian::little);

// The major type in the three highest bits of a CBOR item's first byte.
enum class Major : uint8_t { text = 3 << 5, bytes = 2 << 5, array = 4 << 5, map = 5 << 5, tag = 6 << 5 };

// Writes typed arrays (RFC 8746, section 2.1), little-endian.
template <class T>
constexpr uint64_t tag_of = 0;
template <>
constexpr uint64_t tag_of<uint8_t> = 64;
template <>
constexpr uint64_t tag_of<uint32_t> = 70;
template <>
constexpr uint64_t tag_of<double> = 86;

class Cbor {
 public:
  void head(Major major, uint64_t value) {
    const auto first = static_cast<uint8_t>(major);
    const int bytes = value < 24 ? 0 : value < 0x100 ? 1 : value < 0x10000 ? 2 : value < 0x100000000 ? 4 : 8;
    const int code = bytes == 0 ? static_cast<int>(value) : 24 + std::countr_zero(static_cast<unsigned>(bytes));
    out_.push_back(static_cast<char>(first | code));
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) out_.push_back(static_cast<char>(value >> shift & 0xFF));
  }
  void text(std::string_view value) {
    head(Major::text, value.size());
    out_.append(value);
  }
  void texts(std::string_view key, const std::vector<std::string>& values) {
    text(key);
    head(Major::array, values.size());
    for (const std::string& value : values) text(value);
  }
  template <class T>
  void column(std::string_view key, const T* values, size_t count) {
    text(key);
    head(Major::tag, tag_of<T>);
    head(Major::bytes, count * sizeof(T));
    out_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  template <class T>
  void column(std::string_view key, const std::vector<T>& values) {
    column(key, values.data(), values.size());
  }
  std::string take() && { return std::move(out_); }

 private:
  std::string out_;
};

void write_links(Cbor& out, const std::vector<LinkFigures>& figures) {
  const auto column = [&](std::string_view key, auto get) {
    std::vector<decltype(get(figures[0]))> values;
    values.reserve(figures.size());
    for (const LinkFigures& link : figures) values.push_back(get(link));
    out.column(key, values);
  };
  out.text("links");
  out.head(Major::map, 11);
  column("tx", [](const LinkFigures& link) { return link.tx; });
  column("rx", [](const LinkFigures& link) { return link.rx; });
  column("paths", [](const LinkFigures& link) { return link.paths; });
  column("los", [](const LinkFigures& link) { return static_cast<uint8_t>(link.los); });
  column("path_gain_db", [](const LinkFigures& link) { return link.path_gain_db; });
  column("sum_of_powers_db", [](const LinkFigures& link) { return link.sum_of_powers_db; });
  column("narrowband_gain_db", [](const LinkFigures& link) { return link.narrowband_gain_db; });
  column("mean_delay_s", [](const LinkFigures& link) { return link.mean_delay_s; });
  column("rms_delay_spread_s", [](const LinkFigures& link) { return link.rms_delay_spread_s; });
  column("doppler_spread_hz", [](const LinkFigures& link) { return link.doppler_spread_hz; });
  column("missed_power_share", [](const LinkFigures& link) { return link.missed_power_share; });
}

void write_paths(Cbor& out, const Paths& paths) {
  std::vector<double> coefficients;  // without the ports that no antenna has
  const size_t ports = size_t{paths.rx_ports} * paths.tx_ports;
  coefficients.reserve(2 * ports * paths.size());
  for (const auto& a : paths.a)
    for (size_t k = 0; k < ports; ++k) coefficients.insert(coefficients.end(), {a[k].real(), a[k].imag()});
  out.text("paths");
  out.head(Major::map, 8);
  out.column("delay_s", paths.delay_s);
  out.column("gain_db", paths.gain_db);
  out.column("a", coefficients);
  out.column("doppler_hz", paths.doppler_hz);
  out.column("aod_theta_rad", paths.aod_theta_rad);
  out.column("aod_phi_rad", paths.aod_phi_rad);
  out.column("aoa_theta_rad", paths.aoa_theta_rad);
  out.column("aoa_phi_rad", paths.aoa_phi_rad);
}

void write_vertices(Cbor& out, const LiveFrame& frame) {
  const Paths& paths = frame.result.paths;
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  const double* positions = paths.vertex_position_m.empty() ? nullptr : &paths.vertex_position_m[0].x;
  out.texts("ids", frame.instances);
  out.text("vertices");
  out.head(Major::map, 5);
  out.column("depth", paths.depth);
  out.column("position_m", positions, 3 * paths.vertex_position_m.size());
  out.column("interaction", paths.vertex_interaction);
  out.column("surface", paths.vertex_surface);
  out.column("vehicle", paths.vertex_instance);
}

void write_radar_row(Cbor& out, const LiveFrame& frame, const RadarAnswer& radars, size_t radar, const RadarRow& row) {
  const RadarAxes& axes = radars.axes[radar];
  const auto text = [&](std::string_view key, std::string_view value) {
    out.text(key);
    out.text(value);
  };
  const auto numbers = [&](std::string_view key, const std::vector<double>& values) { out.column(key, values); };
  out.head(Major::map, radars.cubes ? 10 : 6);
  text("radar", radars.config.radars[radar].name);
  text("tx", frame.transmitters[row.link.tx]);
  text("rx", frame.receivers[row.link.rx]);
  numbers("frequency_hz", {radars.config.radio.frequency_hz});
  numbers("left_out", {static_cast<double>(row.left_out)});
  out.text("detections");
  out.head(Major::map, detection_columns.size());
  for (const DetectionColumn& column : detection_columns) numbers(column.name, row.detections.*column.values);
  if (!radars.cubes) return;
  numbers("antennas", {static_cast<double>(axes.rx_antennas), static_cast<double>(axes.tx_antennas)});
  numbers("delay_s", axes.delay_s);
  numbers("doppler_hz", axes.doppler_hz);
  // A complex number is its real and its imaginary part.
  out.column("cube", reinterpret_cast<const double*>(row.cube.data()), 2 * row.cube.size());
}

}  // namespace

std::string channel_columns(const LiveFrame& frame, const std::vector<LinkFigures>& figures, Detail detail,
                            const RadarAnswer& radars) {
  Cbor out;
  const uint64_t keys = detail == Detail::links ? 3 : detail == Detail::paths ? 4 : 6;
  out.head(Major::map, keys + (radars.rows.empty() ? 0 : 1));
  out.texts("transmitters", frame.transmitters);
  out.texts("receivers", frame.receivers);
  write_links(out, figures);
  if (detail != Detail::links) write_paths(out, frame.result.paths);
  if (detail == Detail::vertices) write_vertices(out, frame);
  if (!radars.rows.empty()) {
    out.text("radars");
    out.head(Major::array, radars.row_count());
    for (size_t radar = 0; radar < radars.rows.size(); ++radar)
      for (const RadarRow& row : radars.rows[radar]) write_radar_row(out, frame, radars, radar, row);
  }
  return std::move(out).take();
}

}  // namespace wavetracer::live
