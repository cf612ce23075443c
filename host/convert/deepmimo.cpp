// SPDX-License-Identifier: Apache-2.0
// Writes a scenario folder of DeepMIMO 4: each transmitter has one .npz per array, (receiver, path), NaN where there is
// no path. Its phase is that of the channel at the carrier, arg(a) - 2 pi f delay; its channels are h(f), with
// subcarrier 0 at f.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include "base/pending_folder.hpp"
#include "convert/convert.hpp"
#include "convert/deepmimo_scene.hpp"
#include "convert/npz.hpp"
#include "convert/response_arrays.hpp"
#include "radio/link_groups.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr uint32_t tx_set = 0, rx_set = 1;  // the scenario's sets: all transmitters, all receivers
constexpr size_t default_paths = 25;        // number of paths of each link that dm.load() loads by default
constexpr uint32_t most_digits = 15;        // digits of an interaction code that a double holds exactly

struct Sizes {
  size_t paths = 1, depth = 1;
};

double degrees(double radians) { return radians * (180 / std::numbers::pi); }

// Returns the code with one digit per interaction, from the transmitter on.
double interaction_code(const Paths& paths, size_t row) {
  double code = 0;
  for (uint64_t v = paths.vertex_offset[row]; v < paths.vertex_offset[row + 1]; ++v) {
    const InteractionKind* kind = find_interaction(paths.vertex_interaction[v]);
    if (!kind || kind->deepmimo == 0)
      throw InputError(
          fmt::format("path {} has an interaction of the kind {}, which DeepMIMO has no number for{}", row,
                      kind ? std::string(kind->word) : std::to_string(paths.vertex_interaction[v]),
                      kind && kind->code == target_point ? "; run once more with trace.target = false" : ""));
    code = 10 * code + kind->deepmimo;
  }
  return code;
}

// The line of sight comes first, because DeepMIMO looks for it there; then come the strongest paths, because it loads
// the first ones.
void order_rows(const Paths& paths, std::span<uint32_t> rows) {
  std::stable_sort(rows.begin(), rows.end(), [&](uint32_t a, uint32_t b) {
    const bool los_a = paths.depth[a] == 0, los_b = paths.depth[b] == 0;
    return los_a != los_b ? los_a : std::norm(paths.a[a][0]) > std::norm(paths.a[b][0]);
  });
}

// The arrays of one transmitter in one frame; all are (receiver, path) except inter_pos.
struct TransmitterArrays {
  Sizes sizes;
  std::vector<double> power, phase, delay, aoa_az, aoa_el, aod_az, aod_el, inter, inter_pos, doppler;

  TransmitterArrays(size_t receivers, const Sizes& s) : sizes(s) {
    for (auto* column : {&power, &phase, &delay, &aoa_az, &aoa_el, &aod_az, &aod_el, &inter})
      column->assign(receivers * sizes.paths, nan);
    inter_pos.assign(receivers * sizes.paths * sizes.depth * 3, nan);
    doppler.assign(receivers * sizes.paths, 0);
  }

  void put(const Paths& paths, size_t row, size_t cell, double frequency_hz) {
    const std::complex<double> a = paths.a[row][0];
    const double turns = frequency_hz * paths.delay_s[row];
    power[cell] = 20 * std::log10(std::abs(a));
    phase[cell] = std::remainder(degrees(std::arg(a)) - 360 * std::remainder(turns, 1), 360);
    delay[cell] = paths.delay_s[row];
    aoa_az[cell] = degrees(paths.aoa_phi_rad[row]);
    aoa_el[cell] = degrees(paths.aoa_theta_rad[row]);
    aod_az[cell] = degrees(paths.aod_phi_rad[row]);
    aod_el[cell] = degrees(paths.aod_theta_rad[row]);
    inter[cell] = interaction_code(paths, row);
    doppler[cell] = paths.doppler_hz[row];
    for (size_t d = 0; d < paths.depth[row]; ++d)
      for (size_t i = 0; i < 3; ++i)
        inter_pos[(cell * sizes.depth + d) * 3 + i] =
            paths.vertex_position_m[paths.vertex_offset[row] + d][static_cast<glm::length_t>(i)];
  }
};

void write_array(const PendingFolder& folder, const std::filesystem::path& where, const std::string& name, size_t tx,
                 const Npz::Shape& shape, std::span<const double> values) {
  const auto file = where / fmt::format("{}_t{:03}_tx{:03}_r{:03}.npz", name, tx_set, tx, rx_set);
  Npz npz([&](std::span<const std::byte> bytes) { folder.append(file, bytes); });
  npz.add(name, shape, values);
  npz.finish();
}

std::vector<double> flat(std::span<const glm::dvec3> points) {
  std::vector<double> out;
  for (const glm::dvec3& p : points) out.insert(out.end(), {p.x, p.y, p.z});
  return out;
}

void write_transmitter(const PendingFolder& folder, const std::filesystem::path& where, const SavedFrame& frame,
                       size_t tx, const TransmitterArrays& arrays) {
  const size_t receivers = frame.receiver_position_m.size();
  const auto write = [&](const char* name, const Npz::Shape& shape, std::span<const double> values) {
    write_array(folder, where, name, tx, shape, values);
  };
  const Npz::Shape per_path{receivers, arrays.sizes.paths};
  write("power", per_path, arrays.power);
  write("phase", per_path, arrays.phase);
  write("delay", per_path, arrays.delay);
  write("aoa_az", per_path, arrays.aoa_az);
  write("aoa_el", per_path, arrays.aoa_el);
  write("aod_az", per_path, arrays.aod_az);
  write("aod_el", per_path, arrays.aod_el);
  write("inter", per_path, arrays.inter);
  write("doppler", per_path, arrays.doppler);
  write("inter_pos", {receivers, arrays.sizes.paths, arrays.sizes.depth, 3}, arrays.inter_pos);
  write("rx_pos", {receivers, 3}, flat(frame.receiver_position_m));
  write("tx_pos", {1, 3}, flat(std::span(&frame.transmitter_position_m[tx], 1)));
}

void write_frame(const PendingFolder& folder, const std::filesystem::path& where, const SavedFrame& frame,
                 const Sizes& sizes, double frequency_hz) {
  const Paths& paths = frame.paths;
  LinkGroups groups = group_by_link(paths.tx, paths.rx);
  size_t group = 0;
  for (size_t tx = 0; tx < frame.transmitter_position_m.size(); ++tx) {
    TransmitterArrays arrays(frame.receiver_position_m.size(), sizes);
    for (; group < groups.size() && paths.tx[groups.rows(group)[0]] == tx; ++group) {
      const std::span<uint32_t> rows = groups.rows(group);
      order_rows(paths, rows);
      for (size_t k = 0; k < rows.size(); ++k)
        arrays.put(paths, rows[k], paths.rx[rows[k]] * sizes.paths + k, frequency_hz);
    }
    write_transmitter(folder, where, frame, tx, arrays);
  }
}

// Writes the channels of each transmitter in DeepMIMO's order: (receiver, rx antenna, tx antenna, subcarrier, time).
void write_channels(const PendingFolder& folder, const SavedRun& run, const ExportOptions& options,
                    const ResponseArray& all, size_t digits) {
  const size_t per_receiver = all.rx_antennas * all.tx_antennas * all.frequencies * all.times;
  for (size_t frame = 0; frame < all.frames; ++frame)
    for (size_t tx = 0; tx < all.tx; ++tx) {
      const std::filesystem::path where =
          all.frames > 1 ? fmt::format("frame_{:0{}}", run.number(options.first_row + frame), digits) : "";
      std::vector<double> re, im;
      re.reserve(all.rx * per_receiver);
      im.reserve(all.rx * per_receiver);
      for (size_t i = 0; i < all.rx * per_receiver; ++i) {
        const size_t time = i % all.times, k = i / all.times % all.frequencies,
                     t = i / all.times / all.frequencies % all.tx_antennas,
                     receiver = i / all.times / all.frequencies / all.tx_antennas;  // receiver and its antenna
        const size_t pair = ((frame * all.rx * all.rx_antennas + receiver) * all.tx + tx) * all.tx_antennas + t;
        const size_t cell = (pair * all.times + time) * all.frequencies + k;
        re.push_back(all.re[cell]);
        im.push_back(all.im[cell]);
      }
      const Npz::Shape shape{all.rx, all.rx_antennas, all.tx_antennas, all.frequencies, all.times};
      write_array(folder, where, "channel_re", tx, shape, re);
      write_array(folder, where, "channel_im", tx, shape, im);
    }
}

// Returns the sizes of the arrays, and the number of receivers that have a path.
Sizes measure(const SavedRun& run, const ExportOptions& options, size_t& active_receivers) {
  Sizes sizes;
  std::vector<bool> active(run.receivers().size());
  for (size_t row = options.first_row; row <= options.last_row; ++row) {
    const Paths paths = run.frame(row).paths;
    for (const uint32_t depth : paths.depth) sizes.depth = std::max<size_t>(sizes.depth, depth);
    for (const uint32_t rx : paths.rx) active[rx] = true;
    LinkGroups groups = group_by_link(paths.tx, paths.rx);
    for (size_t g = 0; g < groups.size(); ++g) sizes.paths = std::max(sizes.paths, groups.rows(g).size());
  }
  active_receivers = static_cast<size_t>(std::ranges::count(active, true));
  return sizes;
}

void check(const SavedRun& run, const ExportOptions& options, const Sizes& sizes) {
  if (run.transmitters().empty() || run.receivers().empty())
    throw InputError("deepmimo: the run has no transmitter or no receiver");
  std::string name = options.output.has_filename() ? options.output.filename().string()
                                                   : options.output.parent_path().filename().string();
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (lower != name)
    throw ConfigError(fmt::format("-o {}: DeepMIMO looks for scenarios in lower case; name the folder {}",
                                  options.output.string(), lower));
  if (sizes.depth > most_digits)
    throw InputError(fmt::format("deepmimo: paths of {} interactions; its codes hold {}", sizes.depth, most_digits));
  const double bytes = 24.0 * static_cast<double>(run.receivers().size()) * static_cast<double>(sizes.paths) *
                       static_cast<double>(sizes.depth);
  if (bytes > static_cast<double>(npz_limit_bytes))
    throw InputError(
        fmt::format("deepmimo: {} receivers x {} paths x {} interactions take {:.3g} GB a transmitter; "
                    "choose fewer frames with --frames",
                    run.receivers().size(), sizes.paths, sizes.depth, bytes / 1e9));
}

nlohmann::ordered_json end_set(const char* name, uint32_t id, bool transmits, size_t points, size_t active) {
  return {{"name", name},
          {"id_orig", id},
          {"id", id},
          {"is_tx", transmits},
          {"is_rx", !transmits},
          {"num_points", points},
          {"num_active_points", active},
          {"num_ant", 1},
          {"dual_pol", false},
          {"ant_rel_positions", {{0, 0, 0}}},
          {"array_orientation", {0, 0, 0}}};
}

nlohmann::ordered_json ray_tracing(const SavedRun& run, const Config& config, const Sizes& sizes) {
  const TraceConfig& trace = config.trace;
  return {{"raytracer_name", "wavetracer"},
          {"raytracer_version", run.version()},
          {"frequency", run.frequency_hz()},
          {"max_path_depth", sizes.depth},
          {"max_reflections", trace.reflection ? trace.max_depth : 0},
          {"max_diffractions", trace.diffraction ? trace.max_diffractions : 0},
          {"max_scattering", trace.scattering ? 1 : 0},
          {"max_transmissions", trace.transmission ? trace.max_transmissions : 0},
          {"diffuse_reflections", 0},
          {"diffuse_diffractions", 0},
          {"diffuse_transmissions", 0},
          {"diffuse_final_interaction_only", false},
          {"diffuse_random_phases", trace.scattering},
          {"terrain_reflection", trace.reflection},
          {"terrain_diffraction", trace.diffraction},
          {"terrain_scattering", trace.scattering},
          {"num_rays", trace.rays.value_or(0)},
          {"ray_casting_method", "uniform"},
          {"synthetic_array", true},
          {"ray_casting_range_az", 360.0},
          {"ray_casting_range_el", 180.0},
          {"gps_bbox", {0, 0, 0, 0}},
          {"raw_params", nlohmann::ordered_json::object()}};
}

void warn(const SavedRun& run, const Sizes& sizes, Warnings& warnings) {
  if (run.rx_ports() > 1 || run.tx_ports() > 1)
    warnings.push_back("deepmimo: it knows one polarisation; first ports of antennas are written (V, or +45 degrees)");
  if (sizes.paths > default_paths)
    warnings.push_back(
        fmt::format("deepmimo: links have up to {} paths, and DeepMIMO loads {} unless told otherwise: "
                    "dm.load(..., max_paths={})",
                    sizes.paths, default_paths, sizes.paths));
  warnings.push_back(
      "deepmimo: it loads no Doppler shifts; doppler_*.npz beside the others hold them, for set_doppler()");
}

}  // namespace

Written export_deepmimo(const SavedRun& run, const ExportOptions& options, Warnings& warnings) {
  size_t active_receivers = 0;
  const Sizes sizes = measure(run, options, active_receivers);
  check(run, options, sizes);
  const DeepmimoScene scene(run, warnings);

  PendingFolder folder(options.output);
  const size_t frames = options.last_row - options.first_row + 1;
  const size_t digits = std::to_string(run.number(options.last_row)).size();
  SceneSize scene_size;
  for (size_t row = options.first_row; row <= options.last_row; ++row) {
    options.tell(row);
    const SavedFrame frame = run.frame(row);
    // DeepMIMO loads snapshots in the order of the names of their folders.
    const std::filesystem::path where = frames > 1 ? fmt::format("frame_{:0{}}", frame.number, digits) : "";
    write_frame(folder, where, frame, sizes, run.frequency_hz());
    scene_size = scene.write(folder, where, frame);
  }
  if (const auto responses = response_array(run, options, "deepmimo")) {
    write_channels(folder, run, options, *responses, digits);
    warnings.push_back(
        "deepmimo: it computes channels itself and loads none; channel_*.npz beside its arrays hold those "
        "of responses.h5, (receiver, rx antenna, tx antenna, subcarrier, time)");
  }
  nlohmann::ordered_json params;
  params["version"] = "4.0.0";
  params["rt_params"] = ray_tracing(run, scene.config(), sizes);
  params["scene"] = {{"num_scenes", frames},
                     {"n_objects", scene_size.objects},
                     {"n_vertices", scene_size.vertices},
                     {"n_faces", scene_size.triangles},
                     {"n_triangular_faces", scene_size.triangles},
                     {"representation", "mesh"}};
  params["materials"] = scene.materials();
  params["txrx_sets"]["txrx_set_0"] =
      end_set("transmitters", tx_set, true, run.transmitters().size(), run.transmitters().size());
  params["txrx_sets"]["txrx_set_1"] = end_set("receivers", rx_set, false, run.receivers().size(), active_receivers);
  folder.append("params.json", json_text(params));
  warn(run, sizes, warnings);
  return {folder.commit()};
}

}  // namespace wavetracer
