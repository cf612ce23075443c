// SPDX-License-Identifier: Apache-2.0
// Lines are written directly: a frame of a hundred vehicles has some 10^5 numbers, and building a JSON tree of them
// would be a waste. Paths and links must be sorted by transmitter and receiver, as Paths promises.
#include "live/answer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/stopwatch.hpp"
#include "live/channel_columns.hpp"
#include "live/json_line.hpp"
#include "radio/links.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer::live {
namespace {

using Json = nlohmann::ordered_json;

void write_paths(Line& line, const Paths& paths, size_t first, size_t end) {
  const auto column = [&](const char* name, const std::vector<double>& values) {
    line.key(name);
    line.list(first, end, [&](size_t i) { line.number(values[i]); });
  };
  const size_t ports = size_t{paths.rx_ports} * paths.tx_ports;
  const auto coefficients = [&](const char* name, auto part) {
    line.key(name);
    line.list(first, end, [&](size_t i) { line.list(0, ports, [&](size_t k) { line.number(part(paths.a[i][k])); }); });
  };
  column("delay_s", paths.delay_s);
  column("gain_db", paths.gain_db);
  coefficients("a_re", [](const std::complex<double>& a) { return a.real(); });
  coefficients("a_im", [](const std::complex<double>& a) { return a.imag(); });
  column("doppler_hz", paths.doppler_hz);
  column("aod_theta_rad", paths.aod_theta_rad);
  column("aod_phi_rad", paths.aod_phi_rad);
  column("aoa_theta_rad", paths.aoa_theta_rad);
  column("aoa_phi_rad", paths.aoa_phi_rad);
}

void write_vertices(Line& line, const LiveFrame& frame, size_t first, size_t end) {
  const Paths& paths = frame.result.paths;
  const auto each = [&](const char* name, const auto& item) {
    line.key(name);
    line.list(first, end, [&](size_t i) { line.list(paths.vertex_offset[i], paths.vertex_offset[i + 1], item); });
  };
  each("vertices_m", [&](size_t v) {
    const glm::dvec3& p = paths.vertex_position_m[v];
    line.list(0, 3, [&](size_t axis) { line.number(p[static_cast<int>(axis)]); });
  });
  each("interactions", [&](size_t v) { line.integer(paths.vertex_interaction[v]); });
  each("surfaces", [&](size_t v) { line.integer(paths.vertex_surface[v]); });
  each("vehicles", [&](size_t v) {
    if (paths.vertex_instance[v] == no_instance)
      line.raw("null");
    else
      line.text(frame.instances[paths.vertex_instance[v]]);
  });
}

void write_links(Line& line, const LiveFrame& frame, const std::vector<LinkFigures>& figures, Detail detail) {
  const Paths& paths = frame.result.paths;
  size_t row = 0;  // row of the link's first path
  line.list(0, figures.size(), [&](size_t i) {
    const LinkFigures& link = figures[i];
    line.raw("{\"tx\":");
    line.text(frame.transmitters[link.tx]);
    line.key("rx");
    line.text(frame.receivers[link.rx]);
    line.key("paths");
    line.integer(link.paths);
    line.key("los");
    line.raw(link.los ? "true" : "false");
    line.key("path_gain_db");
    line.number(link.path_gain_db);
    line.key("sum_of_powers_db");
    line.number(link.sum_of_powers_db);
    line.key("narrowband_gain_db");
    line.number(link.narrowband_gain_db);
    line.key("mean_delay_s");
    line.number(link.mean_delay_s);
    line.key("rms_delay_spread_s");
    line.number(link.rms_delay_spread_s);
    line.key("doppler_spread_hz");
    line.number(link.doppler_spread_hz);
    line.key("missed_power_share");
    line.number(link.missed_power_share);
    const size_t end = row + link.paths;
    if (detail != Detail::links) write_paths(line, paths, row, end);
    if (detail == Detail::vertices) write_vertices(line, frame, row, end);
    row = end;
    line.raw("}");
  });
}

// Writes the power that rays may have missed in the frame.
void write_missed(Line& line, const Missed& missed) {
  const auto range = [&](const char* name, const MissedRange& of) {
    line.raw(name);
    line.raw("{\"estimate\":");
    line.number(of.estimate);
    line.key("low");
    line.number(of.low);
    line.key("high");
    line.number(of.high);
    line.raw("}");
  };
  line.key("missed");
  range("{\"paths\":", missed.paths);
  range(",\"power_share\":", missed.power_share);
  line.raw("}");
}

// Writes to which depth beams have found all paths of the frame, and but for what.
void write_certificate(Line& line, const Certificate& of) {
  line.key("certificate");
  line.raw("{\"depth\":");
  line.integer(of.depth);
  line.key("edges");
  line.integer(of.edges);
  line.key("left_out_sr");
  line.number(of.left_out_sr);
  line.key("left_out_share");
  line.number(of.left_out_share());
  line.key("left_out_power");
  line.number(of.left_out_power);
  line.raw(of.any_depth ? ",\"any_depth\":true" : ",\"any_depth\":false");
  if (of.floor_db) {
    line.key("floor_db");
    line.number(*of.floor_db);
    line.key("weak_share");
    line.number(of.weak_share());
  }
  line.raw("}");
}

Json vector_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json radars_of(const Simulation& simulation) {
  const std::vector<RadarConfig>& radars = simulation.config().radars;
  const std::vector<RadarAxes> axes = simulation.radar_axes();
  Json out = Json::array();
  for (size_t i = 0; i < radars.size(); ++i)
    out.push_back({{"radar", radars[i].name},
                   {"rx_antennas", axes[i].rx_antennas},
                   {"tx_antennas", axes[i].tx_antennas},
                   {"chirps", radars[i].chirps},
                   {"samples", radars[i].samples}});
  return out;
}

}  // namespace

std::string world_line(const Simulation& simulation) {
  const Config& config = simulation.config();
  Json out{{"message", "world"},
           {"protocol", protocol_version},
           {"server", "wavetracer " WAVETRACER_VERSION},
           {"device", simulation.device().name},
           {"frequency_hz", config.radio.frequency_hz}};
  Json features = Json::array();
  for (const auto& [name, feature] : simulation.features())
    if (feature.on) features.push_back(name);
  out["features"] = std::move(features);
  const LiveBounds& bounds = simulation.live_bounds();
  out["bounds_m"] = {{"lower", vector_of(bounds.lower_m)}, {"upper", vector_of(bounds.upper_m)}};
  Json types = Json::array();
  uint32_t places = 0;
  for (const LiveType& type : simulation.live_types()) {
    Json mounts = Json::array();
    for (const MountConfig& mount : type.mounts)
      mounts.push_back({{"name", mount.name},
                        {"role", mount.role.word()},
                        {"offset_m", {mount.offset_m[0], mount.offset_m[1], mount.offset_m[2]}}});
    types.push_back({{"type", type.name},
                     {"places", type.count},
                     {"length_m", type.length_m},
                     {"width_m", type.width_m},
                     {"height_m", type.height_m},
                     {"mounts", std::move(mounts)}});
    places += type.count;
  }
  out["types"] = std::move(types);
  if (!config.radars.empty()) out["radars"] = radars_of(simulation);
  // Fixed ends come before the mounted ones of the first place.
  const auto standing = [&](const std::vector<RadioEnd>& ends, bool (*has)(MountRole)) {
    size_t mounted = 0;
    for (const LiveType& type : simulation.live_types())
      for (const MountConfig& mount : type.mounts)
        if (has(mount.role)) mounted += type.count;
    Json names = Json::array();
    for (size_t i = 0; i + mounted < ends.size(); ++i) names.push_back(ends[i].name);
    return names;
  };
  out["transmitters"] = standing(config.transmitters, sends);
  out["receivers"] = standing(config.receivers, receives);
  out["limits"] = {{"max_message_bytes", config.live.max_message_bytes},
                   {"max_vehicles", places},
                   {"max_pending_frames", config.live.max_pending_frames},
                   {"max_rate_hz", config.live.max_rate_hz},
                   {"idle_timeout_s", config.live.idle_timeout_s.value_or(0)}};
  return out.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string channels_line(const FrameMessage& asked, const LiveFrame& frame, const AnswerForm& form, uint64_t skipped,
                          const FrameTimes& times, const RadarAnswer& radars) {
  Stopwatch watch;
  const FrameResult& result = frame.result;
  const Paths& paths = result.paths;
  Line line;
  line.raw("{\"message\":\"channels\"");
  line.key("frame");
  line.integer(asked.frame);
  line.key("time_s");
  line.number(asked.time_s);
  line.key("skipped");
  line.integer(skipped);
  line.key("rx_ports");
  line.integer(paths.rx_ports);
  line.key("tx_ports");
  line.integer(paths.tx_ports);
  const std::vector<LinkFigures> figures =
      link_figures(paths, result.frame, result.world.links, radars.config.radio.frequency_hz);
  std::string columns;
  if (form.encoding == Encoding::cbor) {
    columns = channel_columns(frame, figures, form.detail, radars);
    line.key("bytes");
    line.integer(columns.size());
  } else {
    line.key("links");
    write_links(line, frame, figures, form.detail);
    if (!radars.rows.empty()) write_radars(line, frame, radars);
  }
  if (result.missed.frames > 0) write_missed(line, estimate_missed(result.missed));
  if (result.missed.unknown > 0) {
    line.key("missed_unknown");
    line.raw("true");
  }
  if (result.certificate.frames > 0) write_certificate(line, result.certificate);
  if (!result.warnings.empty()) {
    line.key("warnings");
    line.list(0, result.warnings.size(), [&](size_t i) { line.text(result.warnings[i]); });
  }
  line.key("seconds");
  line.raw("{\"wait\":");
  line.number(times.wait_s);
  line.key("solve");
  line.number(times.solve_s);
  line.key("serialise");
  line.number(watch.lap());
  line.raw("}}");
  return std::move(line).take() + columns;
}

std::string error_line(std::string_view code, std::string_view text, std::optional<uint64_t> frame, bool fatal) {
  const std::string number = frame ? fmt::format(",\"frame\":{}", *frame) : "";
  return fmt::format("{{\"message\":\"error\",\"code\":\"{}\"{},\"fatal\":{},\"text\":{}}}\n", code, number, fatal,
                     text_of(text));
}

std::string bye_line(std::string_view reason) {
  return fmt::format("{{\"message\":\"bye\",\"text\":{}}}\n", text_of(reason));
}

}  // namespace wavetracer::live
