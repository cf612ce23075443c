// SPDX-License-Identifier: Apache-2.0
// Writes paths.h5: /paths (one row per path) and /vertices (compressed rows); world_h5.cpp writes the world around
// them. Every dataset has its units and meaning in attributes; the root has the conventions, the config and the
// versions.
#include "output/paths_h5.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include "output/inputs.hpp"
#include "output/world_h5.hpp"
#include "radio/path_power.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

using hdf5::Meaning;

// A table with columns of different lengths would be written as a file that reads well but is wrong.
bool is_rectangular(const Paths& paths) {
  const size_t rows = paths.size(), vertices = paths.vertex_position_m.size();
  bool whole = paths.vertex_offset.size() == rows + 1 && paths.vertex_offset.front() == 0 &&
               paths.vertex_offset.back() == vertices && paths.a.size() == rows;
  for (const auto* column : {&paths.frame, &paths.tx, &paths.rx, &paths.depth}) whole &= column->size() == rows;
  for (const auto* column : {&paths.gain_db, &paths.aod_theta_rad, &paths.aod_phi_rad, &paths.aoa_theta_rad,
                             &paths.aoa_phi_rad, &paths.doppler_hz})
    whole &= column->size() == rows;
  whole &= paths.lifetime_m.empty() || paths.lifetime_m.size() == rows;
  whole &= paths.group.size() == paths.group_weight.size() && (paths.group.empty() || paths.group.size() == rows);
  whole &= paths.target.empty() || paths.target.size() == rows;
  return whole && paths.vertex_interaction.size() == vertices && paths.vertex_surface.size() == vertices &&
         paths.vertex_instance.size() == vertices;
}

bool names_known_ends(const Paths& paths, const Config& config) {
  const auto below = [](const std::vector<uint32_t>& rows, size_t count) {
    return std::all_of(rows.begin(), rows.end(), [count](uint32_t row) { return row < count; });
  };
  return below(paths.tx, config.transmitters.size()) && below(paths.rx, config.receivers.size());
}

// Every end and instance must have a state, and links and paths must name ends that exist.
bool fits(const FrameResult& frame, const Run& run) {
  const WorldState& world = frame.world;
  const auto named = [&](const Link& link) {
    return link.tx < run.config.transmitters.size() && link.rx < run.config.receivers.size();
  };
  return world.transmitters.size() == run.config.transmitters.size() &&
         world.receivers.size() == run.config.receivers.size() && world.instances.size() == run.instances.size() &&
         std::all_of(world.links.begin(), world.links.end(), named) && names_known_ends(frame.paths, run.config);
}

void check(const Run& run, const FrameResult& frame) {
  if (!is_rectangular(frame.paths) || !fits(frame, run))
    throw RuntimeError(
        fmt::format("the paths of frame {} have columns of unequal length, or ends or vehicles that the run lacks; "
                    "this is a fault of wavetracer, report it",
                    frame.frame));
}

// Appends the real or imaginary parts of the coefficients, (path, rx port, tx port), packed from the four slots of
// Paths::a.
void append_coefficients(const Paths& paths, FrameTables& tables, const std::string& name, const Meaning& meaning,
                         double (*part)(const std::complex<double>&)) {
  const size_t ports = size_t{paths.rx_ports} * paths.tx_ports;
  std::vector<double> values;
  values.reserve(paths.size() * ports);
  for (const auto& a : paths.a)
    for (size_t i = 0; i < ports; ++i) values.push_back(part(a[i]));
  tables.append<double>(name, meaning, values, {paths.rx_ports, paths.tx_ports});
}

// Without groups, each path is its own group, numbered within its link.
void append_groups(const Paths& paths, FrameTables& tables) {
  std::vector<GroupNumbers> own;
  std::vector<GroupWeights> whole;
  for (size_t first = 0, end = 0; paths.group.empty() && first < paths.size(); first = end) {
    end = end_of_link(paths, first);
    for (size_t row = first; row < end; ++row) own.push_back(only_group(static_cast<uint32_t>(row - first)));
  }
  whole.assign(own.size(), whole_weight);
  const auto flat = [rows = paths.size()](const auto& column) {
    return std::span(rows > 0 ? column[0].data() : nullptr, most_groups * rows);
  };
  tables.append<uint32_t>("group",
                          {"1",
                           "numbers of the groups of the path in its link and frame, "
                           "that with the largest weight first; 4294967295 for none"},
                          flat(paths.group.empty() ? own : paths.group), {most_groups});
  tables.append<double>("group_weight",
                        {"1",
                         "the part of the field that is one with each group; "
                         "the power of a link is the sum over groups and pairs of ports of |sum over paths "
                         "of weight a exp(-j 2 pi f delay_s)|^2"},
                        flat(paths.group.empty() ? whole : paths.group_weight), {most_groups});
}

// targets: the run has any.
void append_paths(const Paths& paths, bool targets, bool lifetimes, FrameTables& tables) {
  tables.group("/paths", "one row per path, sorted by frame, tx, rx, delay");
  const auto column = [&](const char* name, const char* units, const char* description, const auto& values) {
    tables.append(name, {units, description}, std::span(values));
  };
  column("frame", "1", "number of the frame, see /frames/frame", paths.frame);
  column("tx", "1", "row of /transmitters", paths.tx);
  column("rx", "1", "row of /receivers", paths.rx);
  column("depth", "1", "number of interactions, 0 is line of sight", paths.depth);
  column("delay_s", "s", "length of the path divided by the speed of light", paths.delay_s);
  column("gain_db", "dB", "10 log10 of the sum of |a|^2 over all ports", paths.gain_db);
  const std::string a =
      " part of the passband coefficient a between the antenna ports, without the carrier phase of the delay; "
      "shape (path, rx port, tx port), port 0 is V (or +45 deg), port 1 is H (or -45 deg)";
  append_coefficients(paths, tables, "a_re", {"1", "real" + a}, [](const auto& z) { return z.real(); });
  append_coefficients(paths, tables, "a_im", {"1", "imaginary" + a}, [](const auto& z) { return z.imag(); });
  column("aod_theta_rad", "rad", "direction in which the path leaves, angle from +z", paths.aod_theta_rad);
  column("aod_phi_rad", "rad", "direction in which the path leaves, angle from +x towards +y", paths.aod_phi_rad);
  column("aoa_theta_rad", "rad", "direction from which the path arrives, seen from the receiver, angle from +z",
         paths.aoa_theta_rad);
  column("aoa_phi_rad", "rad",
         "direction from which the path arrives, seen from the receiver, angle from +x towards +y", paths.aoa_phi_rad);
  column("doppler_hz", "Hz", "shift of the received frequency, positive when the path gets shorter", paths.doppler_hz);
  if (targets)
    column("target", "1", "row of /targets, the target that the path goes by; 4294967295 for none", paths.target);
  append_groups(paths, tables);
  if (lifetimes)
    column("lifetime_m", "m",
           "the path is there as long as both of its ends and all points of all vehicles are no farther than this from "
           "their places; a lower bound, 0 where none is known",
           paths.lifetime_m);
  column("vertex_offset", "1",
         "the vertices of path i are rows vertex_offset[i] to vertex_offset[i + 1] - 1 of /vertices",
         paths.vertex_offset);
}

void append_vertices(const Paths& paths, FrameTables& tables) {
  tables.group("/vertices", "the interactions of all paths, each path's from tx to rx, ends excluded");
  static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
  const auto& points = paths.vertex_position_m;
  tables.append<double>("position_m", {"m", "position in the coordinates of the scene file, (x, y, z)"},
                        {reinterpret_cast<const double*>(points.data()), 3 * points.size()}, {3});
  const auto column = [&](const char* name, const char* description, const auto& values) {
    tables.append(name, {"1", description}, std::span(values));
  };
  column("interaction", interaction_legend().c_str(), paths.vertex_interaction);
  column("surface",
         "surface of the scene, or of the model of the instance that was hit; of a diffraction the edge, "
         "as `wavetracer scene info --edges` numbers them; of a target its point; numbers hold for one file",
         paths.vertex_surface);
  column("instance", "row of /instances, the vehicle that was hit; 4294967295 for the static scene",
         paths.vertex_instance);
}

void write_root(hdf5::File& file, const Run& run) {
  const auto text = [&](const char* name, const std::string& value) { hdf5::write_attribute(file.id(), name, value); };
  text("format", "wavetracer paths");
  hdf5::write_attribute(file.id(), "format_version", uint32_t{1});
  text("version", run.summary.version);
  text("config_file", run.config.file);
  text("config", run.config.text);
  text("scene_file", run.scene.file);
  hdf5::write_attribute(file.id(), "frequency_hz", std::span(&run.config.radio.frequency_hz, 1));
  text("convention_channel",
       "h(f) = sum over paths of a exp(-j 2 pi f delay_s), f the absolute frequency in Hz; "
       "free space between isotropic antennas gives |a| = wavelength / (4 pi distance)");
  text("convention_polarization",
       "V is the theta unit vector and H the phi unit vector of the global spherical coordinates at each end, "
       "turned with the antenna");
  text("convention_coordinates", "right-handed, z up, metres, those of the scene file after its scale and up axis");
}

}  // namespace

void encode_head_h5(const Run& run, hdf5::File& file) {
  write_root(file, run);
  write_inputs(file, run.summary.inputs);
  write_instances(file, run);
  write_ends(file, run);
  write_targets(file, run);
}

void append_frame_h5(const Run& run, const FrameResult& frame, FrameTables& tables) {
  check(run, frame);
  append_frame(run, frame, tables);
  append_links(frame, tables);
  append_paths(frame.paths, !run.targets.empty(), run.config.output.lifetimes, tables);
  append_poses(run, frame, tables);
  append_vertices(frame.paths, tables);
}

}  // namespace wavetracer
