// SPDX-License-Identifier: Apache-2.0
// Checks of tables that need the whole configuration: of arrays and carriers, names that nothing has and keys that
// exclude each other; of vehicles, their sources, antennas and times; of places, degrees and air whose models are valid
// at each carrier; of materials.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/spelling.hpp"
#include "config/contradictions.hpp"
#include "config/value_text.hpp"

namespace wavetracer::config {
namespace {

constexpr uint64_t most_elements = 65536;  // limit of an array

template <class End>
void check_references(const std::string& table, const std::vector<End>& ends, const std::vector<std::string>& arrays,
                      std::vector<Contradiction>& out) {
  for (size_t i = 0; i < ends.size(); ++i) {
    const std::string& name = ends[i].array;
    if (name.empty() || std::ranges::find(arrays, name) != arrays.end()) continue;
    out.push_back({{fmt::format("{}.{}.array", table, i)},
                   fmt::format("{}.array = {}: there is no [[array]] of this name{}; add one, or remove the key", table,
                               toml_string(name), spelling_hint(name, arrays))});
  }
}

void check_panel(const ArrayConfig& array, const std::string& key, std::vector<Contradiction>& out) {
  const std::string named = fmt::format("[[array]] {}", toml_string(array.name));
  const bool panel = array.rows > 1 || array.columns > 1 || array.vertical_spacing_m || array.horizontal_spacing_m;
  if (!array.positions_m.empty() && panel)
    out.push_back({{key, key + ".positions_m"},
                   named + " has both positions_m and the keys of a panel (rows, columns, spacing): "
                           "give either of them"});
  if (!array.positions_m.empty() && array.codebook == "dft")
    out.push_back({{key, key + ".codebook"},
                   named + " has positions_m, but codebook = \"dft\" needs a panel of rows and columns: "
                           "give a codebook file, or \"none\""});
  const uint64_t elements = std::max<uint64_t>(uint64_t{array.rows} * array.columns, array.positions_m.size());
  if (elements > most_elements)
    out.push_back(
        {{key, key + ".rows", key + ".columns"},
         fmt::format("{} has {} elements, and {} are the limit: make it smaller", named, elements, most_elements)});
}

void check_carriers(const RadioConfig& radio, std::vector<Contradiction>& out) {
  std::vector<double> sorted = radio.frequencies_hz;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    out.push_back(
        {{"radio.frequencies_hz"}, fmt::format("radio.frequencies_hz has {} twice: name each carrier once", *twice)});
}

// Half of a band lies below its carrier, and frequencies are positive.
void check_bands(const Config& config, std::vector<Contradiction>& out) {
  const RadioConfig& radio = config.radio;
  std::vector<double> carriers = radio.frequencies_hz;
  if (carriers.empty()) carriers.push_back(radio.frequency_hz);
  const double lowest_hz = *std::ranges::min_element(carriers);
  const auto check = [&](const char* key, std::optional<double> bandwidth_hz) {
    if (bandwidth_hz && *bandwidth_hz / 2 >= lowest_hz)
      out.push_back({{key, radio.frequencies_hz.empty() ? "radio.frequency_hz" : "radio.frequencies_hz"},
                     fmt::format("{} = {:g}: half of it is more than the carrier of {:g} Hz, "
                                 "so the band would reach below 0 Hz: give less than twice the carrier",
                                 key, *bandwidth_hz, lowest_hz)});
  };
  check("radio.bandwidth_hz", radio.bandwidth_hz);
  check("response.bandwidth_hz", config.response.bandwidth_hz);
}

void check_times(const std::string& key, const std::vector<std::array<double, 4>>& waypoints, size_t track,
                 std::vector<Contradiction>& out) {
  for (size_t k = 1; k < waypoints.size(); ++k)
    if (!(waypoints[k][0] > waypoints[k - 1][0]))
      out.push_back({{fmt::format("track.{}.{}", track, key)},
                     fmt::format("track.{}[{}] is at {} s, but the waypoint before it is at {} s: times must increase",
                                 key, k, waypoints[k][0], waypoints[k - 1][0])});
}

// A path that a frame leaves out because it is weak ends before its geometry does.
void check_lifetimes(const Config& config, std::vector<Contradiction>& out) {
  if (!config.output.lifetimes) return;
  const auto refuse = [&](const char* key, const char* why) {
    out.push_back({{"output.lifetimes", key},
                   fmt::format("output.lifetimes = true says how far ends may move before a path ends, but {}: "
                               "remove output.lifetimes, or {}",
                               why, key)});
  };
  if (!config.output.paths) refuse("output.paths", "output.paths = false keeps no paths");
  if (config.trace.by_spheres())
    refuse("trace.reception", "with trace.reception = \"sphere\" rays decide which paths there are");
  if (config.trace.floor_db) refuse("trace.floor_db", "trace.floor_db leaves out weak paths");
  if (config.trace.diffraction_floor_db)
    refuse("trace.diffraction_floor_db", "trace.diffraction_floor_db leaves out weak paths");
}

// The device only sums what links.csv has.
void check_sums(const Config& config, std::vector<Contradiction>& out) {
  if (config.output.paths) return;
  const auto refuse = [&](const std::string& key, const char* needs) {
    out.push_back({{"output.paths", key},
                   fmt::format("{} needs the paths of links: give output.paths = true, or remove {}", needs, key)});
  };
  if (config.radio.frequencies_hz.size() > 1) refuse("radio.frequencies_hz", "a run with several carriers");
  if (config.response.bandwidth_hz) refuse("response.bandwidth_hz", "responses.h5");
  for (size_t i = 0; i < config.arrays.size(); ++i)
    if (config.arrays[i].has_codebook()) refuse(fmt::format("array.{}.codebook", i), "a codebook");
  if (config.trace.by_spheres()) refuse("trace.reception", "trace.reception = \"sphere\"");
  if (config.trace.discover_every_s > 0) refuse("trace.discover_every_s", "the count of paths that frames find late");
}

}  // namespace

void check_arrays(const Config& config, std::vector<Contradiction>& out) {
  std::vector<std::string> names;
  for (const ArrayConfig& array : config.arrays) names.push_back(array.name);
  check_references("transmitter", config.transmitters.values(), names, out);
  check_references("receiver", config.receivers.values(), names, out);
  check_references("station", config.stations, names, out);
  check_references("receiver_grid", config.receiver_grids, names, out);
  check_references("mount", config.mounts, names, out);
  for (size_t i = 0; i < config.arrays.size(); ++i) check_panel(config.arrays[i], fmt::format("array.{}", i), out);
  check_carriers(config.radio, out);
  check_bands(config, out);
  check_sums(config, out);
  check_lifetimes(config, out);
}

void check_trajectories(const Config& config, std::vector<Contradiction>& out) {
  const TrajectoriesConfig& t = config.trajectories;
  if (!t.file.empty() && !t.generate.empty())
    out.push_back({{"trajectories.generate", "trajectories.file"},
                   "trajectories.file and trajectories.generate exclude each other: remove one of them"});
  const bool carried = std::ranges::any_of(config.parked, &ParkedConfig::mounts);
  if (t.file.empty() && t.generate.empty() && config.tracks.empty() && config.live_vehicles.empty() && !carried &&
      !config.mounts.empty())
    out.push_back({{"mount.0"},
                   "[[mount]] needs vehicles: give trajectories.file, trajectories.generate, a [[track]] or, "
                   "for `wavetracer serve`, a [[live_vehicle]]"});
  for (size_t i = 0; i < config.tracks.size(); ++i) {
    check_times("waypoints", config.tracks[i].waypoints, i, out);
    check_times("waypoints_wgs84", config.tracks[i].waypoints_wgs84, i, out);
  }
  for (size_t i = 0; i < config.mounts.size(); ++i)
    if (!config.mounts[i].node.empty() && from_ground(config.mounts[i].above))
      out.push_back({{fmt::format("mount.{}.node", i), fmt::format("mount.{}.above", i)},
                     fmt::format("[[mount]] \"{}\": node says how high the antenna is, "
                                 "so above = \"ground\" cannot say it, too: leave one of them out",
                                 config.mounts[i].name)});
  for (size_t i = 0; i < config.parked.size(); ++i)
    if (config.parked[i].places.empty() == config.parked[i].file.empty())
      out.push_back({{fmt::format("parked.{}.places", i), fmt::format("parked.{}.file", i)},
                     fmt::format("[[parked]] \"{}\" needs places or a file, {}", config.parked[i].name,
                                 config.parked[i].places.empty() ? "and has neither" : "and not both")});
  const TimeConfig& time = config.time;
  if (time.start_s && time.end_s && *time.end_s < *time.start_s)
    out.push_back({{"time.start_s", "time.end_s"},
                   fmt::format("time.end_s = {} is before time.start_s = {}: give an end that is later than the start",
                               *time.end_s, *time.start_s)});
}

// Ranges are those of the recommendations. fog: P.840 assumes Rayleigh scattering.
void check_air(const Config& config, std::vector<Contradiction>& out) {
  std::vector<double> carriers = config.radio.frequencies_hz;
  carriers.push_back(config.radio.frequency_hz);
  const auto check = [&](bool on, const char* key, const char* recommendation, double from_hz, double to_hz) {
    if (!on) return;
    for (const double hz : carriers)
      if (hz < from_hz || hz > to_hz)
        out.push_back({{std::string("air.") + key, "radio.frequency_hz"},
                       fmt::format("air.{}: ITU-R {} is known from {:g} to {:g} GHz, but a carrier is {:g} GHz: "
                                   "remove air.{}",
                                   key, recommendation, from_hz / 1e9, to_hz / 1e9, hz / 1e9, key)});
  };
  check(config.air.rain_mm_h > 0, "rain_mm_h", "P.838-3", 1e9, 1e12);
  check(config.air.gases, "gases", "P.676-13", 1e9, 1e12);
  check(config.air.fog_g_m3 > 0, "fog_g_m3", "P.840-8", 0, 200e9);
}

void check_degrees(const Config& config, std::vector<Contradiction>& out) {
  const auto check = [&](const std::string& key, double latitude, double longitude) {
    if (std::abs(latitude) > 90 || std::abs(longitude) > 180)
      out.push_back({{key},
                     fmt::format("latitude {} and longitude {} are no place on the earth: give the latitude first, "
                                 "from -90 to 90 degrees, then the longitude, from -180 to 180",
                                 latitude, longitude)});
  };
  const auto check_all = [&](const char* table, const std::vector<RadioEnd>& ends) {
    for (size_t i = 0; i < ends.size(); ++i)
      if (const auto& p = ends[i].position_wgs84)
        check(fmt::format("{}.{}.position_wgs84", table, i), (*p)[0], (*p)[1]);
  };
  check_all("transmitter", config.transmitters);
  check_all("receiver", config.receivers);
  check_all("station", config.stations);
  for (size_t i = 0; i < config.tracks.size(); ++i)
    for (const auto& p : config.tracks[i].waypoints_wgs84)
      check(fmt::format("track.{}.waypoints_wgs84", i), p[1], p[2]);
  for (size_t i = 0; i < config.receiver_grids.size(); ++i) {
    const ReceiverGridConfig& grid = config.receiver_grids[i];
    if (const auto& p = grid.south_west_wgs84)
      check(fmt::format("receiver_grid.{}.south_west_wgs84", i), (*p)[0], (*p)[1]);
    if (const auto& p = grid.north_east_wgs84)
      check(fmt::format("receiver_grid.{}.north_east_wgs84", i), (*p)[0], (*p)[1]);
  }
}

// The same holds for tables that a user of the library makes, see host/scene/material_checks.hpp.
void check_materials(const std::vector<MaterialConfig>& materials, std::vector<Contradiction>& out) {
  for (size_t i = 0; i < materials.size(); ++i) {
    const MaterialConfig& m = materials[i];
    if ((m.a || m.b || m.c || m.d) && (m.permittivity || m.conductivity_s_m))
      out.push_back({{fmt::format("material.{}", i)},
                     "[[material]] has both a, b, c, d and permittivity or conductivity_s_m: "
                     "give either the first four or the last two"});
    if (m.layers.empty()) continue;
    const auto refuse = [&](bool given, const char* key) {
      if (given)
        out.push_back({{fmt::format("material.{}.layers", i), fmt::format("material.{}.{}", i, key)},
                       fmt::format("[[material]] has both layers and {0}: remove {0}, since the layers say what the "
                                   "wall is made of",
                                   key)});
    };
    refuse(!m.library.empty(), "library");
    refuse(m.a.has_value(), "a");
    refuse(m.b.has_value(), "b");
    refuse(m.c.has_value(), "c");
    refuse(m.d.has_value(), "d");
    refuse(m.permittivity.has_value(), "permittivity");
    refuse(m.conductivity_s_m.has_value(), "conductivity_s_m");
    refuse(m.thickness_m.has_value(), "thickness_m");
    refuse(is_vegetation(m.vegetation), "vegetation");
  }
}

void check_scattering(const TraceConfig& trace, std::vector<Contradiction>& out) {
  if (!trace.scattering_diffraction || (trace.diffraction && trace.reflects_scattered())) return;
  out.push_back(
      {{"trace.scattering_diffraction", "trace.diffraction", "trace.scattering", "trace.scattering_reflections"},
       fmt::format("trace.scattering_diffraction = true needs trace.diffraction = true, trace.scattering = "
                   "true and trace.scattering_reflections of at least 1, but they are {}, {} and {}: set "
                   "them, or set trace.scattering_diffraction to false",
                   trace.diffraction, trace.scattering, trace.scattering_reflections)});
}

}  // namespace wavetracer::config
