// paths.h5: /paths (one row a path) and /vertices (compressed rows); the world around them is in world_h5.cpp.
// Every dataset says its units and meaning in attributes; the root has the conventions, the config and the versions.
#include "output/paths_h5.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include "output/world_h5.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using hdf5::Meaning;
using hdf5::Rows;

uint64_t path_count(Frames frames) {
  uint64_t count = 0;
  for (const FrameResult& frame : frames) count += frame.paths.size();
  return count;
}

uint64_t vertex_count(Frames frames) {
  uint64_t count = 0;
  for (const FrameResult& frame : frames) count += frame.paths.vertex_position_m.size();
  return count;
}

// A table that is not rectangular would be written as a file that reads well and is wrong.
bool is_rectangular(const Paths& paths) {
  const size_t rows = paths.size(), vertices = paths.vertex_position_m.size();
  bool whole = paths.vertex_offset.size() == rows + 1 && paths.vertex_offset.front() == 0 &&
               paths.vertex_offset.back() == vertices && paths.a.size() == rows;
  for (const auto* column : {&paths.frame, &paths.tx, &paths.rx, &paths.depth}) whole &= column->size() == rows;
  for (const auto* column : {&paths.gain_db, &paths.aod_theta_rad, &paths.aod_phi_rad, &paths.aoa_theta_rad,
                             &paths.aoa_phi_rad, &paths.doppler_hz})
    whole &= column->size() == rows;
  return whole && paths.vertex_interaction.size() == vertices && paths.vertex_surface.size() == vertices &&
         paths.vertex_instance.size() == vertices;
}

// Receiver and transmitter ports of all frames; a frame without paths may not know them.
std::array<uint32_t, 2> port_counts(Frames frames) {
  std::array<uint32_t, 2> ports{1, 1};
  for (const FrameResult& frame : frames)
    ports = {std::max(ports[0], frame.paths.rx_ports), std::max(ports[1], frame.paths.tx_ports)};
  return ports;
}

bool names_known_ends(const Paths& paths, const Config& config) {
  const auto below = [](const std::vector<uint32_t>& rows, size_t count) {
    return std::all_of(rows.begin(), rows.end(), [count](uint32_t row) { return row < count; });
  };
  return below(paths.tx, config.transmitters.size()) && below(paths.rx, config.receivers.size());
}

// Every end and instance has a state, and links and paths name ends that there are.
bool fits(const FrameResult& frame, const Run& run) {
  const WorldState& world = frame.world;
  const auto named = [&](const Link& link) {
    return link.tx < run.config.transmitters.size() && link.rx < run.config.receivers.size();
  };
  return world.transmitters.size() == run.config.transmitters.size() &&
         world.receivers.size() == run.config.receivers.size() && world.instances.size() == run.instances.size() &&
         std::all_of(world.links.begin(), world.links.end(), named) && names_known_ends(frame.paths, run.config);
}

void check(const Run& run, Frames frames) {
  for (const FrameResult& frame : frames) {
    const Paths& paths = frame.paths;
    if (!is_rectangular(paths) || !fits(frame, run) ||
        (paths.size() > 0 && std::array{paths.rx_ports, paths.tx_ports} != port_counts(frames)))
      throw RuntimeError(
          fmt::format("the paths of frame {} have columns of unequal length, ends or vehicles that the run lacks or "
                      "ports unlike the other frames'; this is a fault of wavetracer, report it",
                      frame.frame));
  }
}

template <typename T>
void write_column(const hdf5::File& file, Frames frames, uint64_t rows, const std::string& path,
                  const Meaning& meaning, std::vector<T> Paths::*column) {
  Rows<T> table(file, path, meaning, {rows});
  for (const FrameResult& frame : frames) table.append(frame.paths.*column);
}

// One part of the coefficients, (path, rx port, tx port), packed from the four slots of Paths::a.
void write_coefficients(const hdf5::File& file, Frames frames, uint64_t rows, const std::string& path,
                        const Meaning& meaning, double (*part)(const std::complex<double>&)) {
  const auto [rx_ports, tx_ports] = port_counts(frames);
  const size_t ports = size_t{rx_ports} * tx_ports;
  Rows<double> table(file, path, meaning, {rows, rx_ports, tx_ports});
  std::vector<double> values;
  for (const FrameResult& frame : frames) {
    values.clear();
    values.reserve(frame.paths.size() * ports);
    for (const auto& a : frame.paths.a)
      for (size_t i = 0; i < ports; ++i) values.push_back(part(a[i]));
    table.append(values);
  }
}

void write_paths(hdf5::File& file, Frames frames) {
  const auto group = file.make_group("/paths", "one row a path, sorted by frame, tx, rx, delay");
  const uint64_t rows = path_count(frames);
  const auto column = [&](const char* name, const char* units, const char* description, auto member) {
    write_column(file, frames, rows, std::string("/paths/") + name, {units, description}, member);
  };
  column("frame", "1", "number of the frame, see /frames/frame", &Paths::frame);
  column("tx", "1", "row of /transmitters", &Paths::tx);
  column("rx", "1", "row of /receivers", &Paths::rx);
  column("depth", "1", "number of interactions, 0 is line of sight", &Paths::depth);
  column("delay_s", "s", "length of the path divided by the speed of light", &Paths::delay_s);
  column("gain_db", "dB", "10 log10 of the sum of |a|^2 over all ports", &Paths::gain_db);
  const std::string a =
      " part of the passband coefficient a between the antenna ports, without the carrier phase of the delay; shape "
      "(path, rx port, tx port), port 0 is V (or +45 deg), port 1 is H (or -45 deg)";
  write_coefficients(file, frames, rows, "/paths/a_re", {"1", "real" + a}, [](const auto& z) { return z.real(); });
  write_coefficients(file, frames, rows, "/paths/a_im", {"1", "imaginary" + a}, [](const auto& z) { return z.imag(); });
  column("aod_theta_rad", "rad", "direction in which the path leaves, angle from +z", &Paths::aod_theta_rad);
  column("aod_phi_rad", "rad", "direction in which the path leaves, angle from +x towards +y", &Paths::aod_phi_rad);
  column("aoa_theta_rad", "rad", "direction from which the path arrives, seen from the receiver, angle from +z",
         &Paths::aoa_theta_rad);
  column("aoa_phi_rad", "rad",
         "direction from which the path arrives, seen from the receiver, angle from +x towards +y",
         &Paths::aoa_phi_rad);
  column("doppler_hz", "Hz", "shift of the received frequency, positive when the path gets shorter",
         &Paths::doppler_hz);

  Rows<uint64_t> offsets(
      file, "/paths/vertex_offset",
      {"1", "the vertices of path i are rows vertex_offset[i] to vertex_offset[i + 1] - 1 of /vertices"}, {rows + 1});
  uint64_t base = 0;
  std::vector<uint64_t> values;
  for (const FrameResult& frame : frames) {
    values.assign(frame.paths.vertex_offset.begin(), frame.paths.vertex_offset.end() - 1);
    for (uint64_t& value : values) value += base;
    offsets.append(values);
    base += frame.paths.vertex_offset.back();
  }
  offsets.append({&base, 1});
}

void write_vertices(hdf5::File& file, Frames frames) {
  const auto group =
      file.make_group("/vertices", "the interactions of all paths, each path's from tx to rx, ends excluded");
  const uint64_t rows = vertex_count(frames);
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  Rows<double> positions(file, "/vertices/position_m",
                         {"m", "position in the coordinates of the scene file, (x, y, z)"}, {rows, 3});
  for (const FrameResult& frame : frames) {
    const auto& points = frame.paths.vertex_position_m;
    positions.append({reinterpret_cast<const double*>(points.data()), 3 * points.size()});
  }
  write_column(file, frames, rows, "/vertices/interaction",
               {"1", "1 reflection, 2 diffuse scattering, 4 transmission, 8 diffraction"}, &Paths::vertex_interaction);
  write_column(file, frames, rows, "/vertices/surface",
               {"1", "surface of the scene, or of the model of the instance that was hit; of a diffraction the edge, as "
                     "`wavetracer scene info --edges` numbers them; numbers hold for one file"},
               &Paths::vertex_surface);
  write_column(file, frames, rows, "/vertices/instance",
               {"1", "row of /instances, the vehicle that was hit; 4294967295 for the static scene"},
               &Paths::vertex_instance);
}

void write_root(hdf5::File& file, const Run& run) {
  const auto text = [&](const char* name, const std::string& value) { hdf5::write_attribute(file.id(), name, value); };
  text("format", "wavetracer paths");
  hdf5::write_attribute(file.id(), "format_version", uint32_t{1});
  text("version", run.summary.version);
  text("command_line", run.summary.command_line);
  text("config_file", run.config.file);
  text("config", run.config.text);
  text("scene_file", run.scene.file);
  text("device", run.summary.device.name);
  text("platform", run.summary.device.platform);
  text("driver", run.summary.device.driver);
  text("opencl_c", run.summary.device.opencl_c);
  hdf5::write_attribute(file.id(), "frequency_hz", std::span(&run.config.radio.frequency_hz, 1));
  text("convention_channel",
       "h(f) = sum over paths of a exp(-j 2 pi f delay_s), f the absolute frequency in Hz; "
       "free space between isotropic antennas gives |a| = wavelength / (4 pi distance)");
  text("convention_polarization",
       "V is the theta unit vector and H the phi unit vector of the global spherical "
       "coordinates at each end, turned with the antenna");
  text("convention_coordinates", "right-handed, z up, metres, those of the scene file after its scale and up axis");
}

}  // namespace

void encode_head_h5(const Run& run, hdf5::File& file) {
  write_root(file, run);
  write_instances(file, run);
  write_ends(file, run);
}

void encode_frames_h5(const Run& run, Frames frames, hdf5::File& file) {
  check(run, frames);
  write_paths(file, frames);
  write_vertices(file, frames);
  write_frames(file, run, frames);
  write_poses(file, run, frames);
  write_links(file, frames);
}

void encode_paths_h5(const Run& run, Frames frames, hdf5::File& file) {
  encode_head_h5(run, file);
  encode_frames_h5(run, frames, file);
}

}  // namespace wavetracer
