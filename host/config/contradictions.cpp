// SPDX-License-Identifier: Apache-2.0
// Each topic has one function, which adds the contradictions that it finds.
// The parser knows where keys stand, and names the place.
#include "config/contradictions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "config/diffraction_range.hpp"
#include "config/edge_rays.hpp"
#include "config/value_text.hpp"
#include "wavetracer/interaction_kinds.hpp"
#include "wavetracer/order_methods.hpp"

namespace wavetracer::config {
namespace {

using Found = std::vector<Contradiction>;

void check_scene(const SceneConfig& scene, Found& out) {
  if (scene.file.empty() && scene.generate.empty())
    out.push_back(
        {{"scene"}, "no scene: give scene.file = \"FILE\", or scene.generate = \"--seed 1\" for a generated city"});
  if (!scene.file.empty() && !scene.generate.empty())
    out.push_back(
        {{"scene.generate", "scene.file"}, "scene.file and scene.generate exclude each other: remove one of them"});
}

void check_launch(const Config& config, Found& out) {
  const uint32_t local = config.launch.local_size.value_or(1);
  if ((local & (local - 1)) != 0)
    out.push_back(
        {{"launch.local_size"},
         fmt::format(
             "launch.local_size = {} is not a power of two: give {}, or 0 to let the program choose for the device",
             local, std::bit_floor(local))});
  const std::optional<OrderMethodRow> method = find_order_method(config.order.method);
  const unsigned curve = method ? method->launch_dimensions : 0;
  const LaunchDimensions shape = config.launch.shape;
  if (curve > 0 && shape != "auto" && shape.index() != curve)
    out.push_back({{"launch.shape", "order.method"},
                   fmt::format("order.method = \"{}\" needs a launch of {} dimensions, but launch.shape = \"{}\" "
                               "is set: remove launch.shape",
                               config.order.method.word(), curve, shape.word())});
}

// A refined launch splits cells of the hilbert map and follows its curve, level by level.
void check_rays(const Config& config, Found& out) {
  const TraceConfig& trace = config.trace;
  if (!trace.rays) {
    if (!along_curve(trace.directions))
      out.push_back({{"trace.rays", "trace.directions"},
                     fmt::format("trace.rays = \"auto\" needs trace.directions = \"horizon\" or \"hilbert\", "
                                 "not \"{}\": remove trace.directions, or give trace.rays a number",
                                 trace.directions.word())});
    if (const auto method = find_order_method(config.order.method); !method || method->key)
      out.push_back({{"trace.rays", "order.method"},
                     fmt::format("trace.rays = \"auto\" launches rays in its own order, "
                                 "but order.method = \"{}\" asks for another one: remove order.method, "
                                 "or give trace.rays a number",
                                 config.order.method.word())});
  } else if (trace.refresh_rays && *trace.refresh_rays > *trace.rays) {
    out.push_back({{"trace.rays", "trace.refresh_rays"},
                   fmt::format("trace.refresh_rays = {} is more than trace.rays = {}, the number in a frame "
                               "that reuses nothing: give a number that is not larger, "
                               "or 0 for a tenth of trace.rays",
                               *trace.refresh_rays, *trace.rays)});
  }
}

// Reception by spheres counts each ray as one sample of the directions that reach a receiver.
void check_reception(const Config& config, Found& out) {
  const TraceConfig& trace = config.trace;
  if (!trace.by_spheres()) return;
  if (!trace.rays)
    out.push_back(
        {{"trace.reception", "trace.rays"},
         "trace.reception = \"sphere\" needs rays that are spread evenly, but trace.rays = \"auto\" launches more "
         "rays where few sequences were found: give trace.rays a number, or use trace.reception = \"exact\""});
}

// Checks features that cannot be combined with reception by spheres or with the recording of waypoints.
void check_features(const Config& config, Found& out) {
  const TraceConfig& trace = config.trace;
  for (const InteractionKind& kind : interaction_kinds) {
    const std::string key = fmt::format("trace.{}", kind.word);
    if (trace.*kind.asked_for && kind.code != reflection && kind.code != target_point && trace.by_spheres())
      out.push_back({{key, "trace.reception"},
                     fmt::format("trace.reception = \"sphere\" receives reflected rays only, but {} = true: "
                                 "set it to false, or use trace.reception = \"exact\"",
                                 key)});
  }
  if (trace.transmission && config.output.waypoints > 0)
    out.push_back(
        {{"output.waypoints", "trace.transmission"},
         fmt::format("output.waypoints = {} needs rays that do not split, but with trace.transmission = true they "
                     "split at every surface: remove output.waypoints, or set trace.transmission to false",
                     config.output.waypoints)});
}

// A signal-to-noise ratio needs a signal and a noise.
void check_link_budget(const RadioConfig& radio, Found& out) {
  if (radio.bandwidth_hz && !radio.transmit_power_dbm)
    out.push_back({{"radio.bandwidth_hz"},
                   fmt::format("radio.bandwidth_hz = {} is the bandwidth of the noise in a link budget, "
                               "which also needs the transmit power: give radio.transmit_power_dbm too, "
                               "or remove radio.bandwidth_hz",
                               *radio.bandwidth_hz)});
  if (radio.noise_figure_db > 0 && !radio.bandwidth_hz)
    out.push_back({{"radio.noise_figure_db"},
                   fmt::format("radio.noise_figure_db = {} needs the bandwidth of the noise: "
                               "give radio.bandwidth_hz too, or remove radio.noise_figure_db",
                               radio.noise_figure_db)});
}

void check_waypoints(const Config& config, Found& out) {
  if (config.output.waypoints > 0 && !config.trace.rays)
    out.push_back({{"output.waypoints", "trace.rays"},
                   fmt::format("output.waypoints = {} selects rays evenly from a known number of rays, "
                               "but with trace.rays = \"auto\" that number is not known: give trace.rays a number, "
                               "or remove output.waypoints",
                               config.output.waypoints)});
}

void check_cache(const Config& config, Found& out) {
  const CacheConfig& cache = config.cache;
  if (config.output.cache_entries && (!cache.on() || !cache.statistics))
    out.push_back(
        {{"output.cache_entries"},
         fmt::format("output.cache_entries = true writes what the ray cache counted for each entry, but {}: {} "
                     "or remove output.cache_entries",
                     cache.on() ? "cache.statistics = false" : "cache.kind = \"none\"",
                     cache.on() ? "set it to true," : "choose a kind of cache with cache.statistics = true,")});
  if (!cache.on()) return;
  if (cache.exact() && cache.holds_all())
    out.push_back({{"cache.key", "cache.scope"},
                   "cache.key = \"exact\" gives the same paths as no cache, but with cache.scope = \"all\" moving "
                   "vehicles would change them: remove cache.scope, or use cache.key = \"quantised\""});
  if (cache.exact() && cache.as_printed())
    out.push_back({{"cache.key", "cache.kind"},
                   fmt::format("cache.key = \"exact\" with cache.kind = \"{}\": "
                               "the tables as the thesis prints them compare no keys, so that no answer is exact: "
                               "use cache.key = \"quantised\", or another kind",
                               cache.kind.text())});
  if (cache.first_depth > config.trace.max_depth)
    out.push_back({{"cache.first_depth", "trace.max_depth", "cache.kind"},
                   fmt::format("cache.first_depth = {} is larger than trace.max_depth = {}, "
                               "so the cache would never be used: lower the first, raise the second, "
                               "or use cache.kind = \"none\"",
                               cache.first_depth, config.trace.max_depth)});
}

// member: the member that holds an element's name. Returns the names of all elements, and adds those that occur twice.
template <class Element>
std::set<std::string> check_names(const std::string& table, const std::string& key, const std::vector<Element>& all,
                                  std::string Element::*member, std::set<std::string> seen, Found& out) {
  for (size_t i = 0; i < all.size(); ++i) {
    const std::string& name = all[i].*member;
    if (!name.empty() && !seen.insert(name).second)
      out.push_back({{fmt::format("{}.{}.{}", table, i, key)},
                     fmt::format("{}.{} = {} is used twice: each {} must be unique, choose another one", table, key,
                                 toml_string(name), key)});
  }
  return seen;
}

void check_ends(const Config& config, Found& out) {
  const auto check = [&](MountRole role, bool (*has)(MountRole), bool none) {
    if (none && std::ranges::none_of(config.mounts, has, &MountConfig::role))
      out.push_back({{},
                     fmt::format("no [[{0}]]: add one with name and position_m, a [[station]], which sends "
                                 "and receives, or a [[mount]] with name and role = \"{0}\" "
                                 "or \"both\" for vehicles",
                                 role.word())});
  };
  check("transmitter", sends, config.transmitters.empty() && config.stations.empty());
  check("receiver", receives, config.receivers.empty() && config.receiver_grids.empty() && config.stations.empty());
  if (config.stations.size() == 1 && config.transmitters.empty() && config.receivers.empty() &&
      config.receiver_grids.empty() && config.mounts.empty())
    out.push_back(
        {{"station.0"},
         "one [[station]] alone has no other end to send to: add a second one, a [[receiver]], or a [[mount]] "
         "for vehicles"});
}

}  // namespace

std::vector<Contradiction> contradictions(const Config& config) {
  Found out;
  check_scene(config.scene, out);
  check_air(config, out);
  check_launch(config, out);
  check_rays(config, out);
  check_discoveries(config, out);
  check_beams(config, out);
  check_floor(config, out);
  check_reception(config, out);
  check_features(config, out);
  check_edge_rays(config, out);
  check_diffraction_range(config, out);
  check_scattering(config.trace, out);
  check_companions(config, out);
  check_link_budget(config.radio, out);
  check_waypoints(config, out);
  check_cache(config, out);
  check_ends(config, out);
  auto names = check_names("transmitter", "name", config.transmitters.values(), &RadioEnd::name, {}, out);
  names = check_names("receiver", "name", config.receivers.values(), &RadioEnd::name, names, out);
  check_names("station", "name", config.stations, &RadioEnd::name, names, out);
  check_names("receiver_grid", "name", config.receiver_grids, &ReceiverGridConfig::name, {}, out);
  check_names("material", "name", config.materials, &MaterialConfig::name, {}, out);
  check_names("mount", "name", config.mounts, &MountConfig::name, {}, out);
  check_names("vehicle_type", "name", config.vehicle_types, &VehicleTypeConfig::name, {}, out);
  check_names("track", "id", config.tracks, &TrackConfig::id, {}, out);
  check_names("parked", "name", config.parked, &ParkedConfig::name, {}, out);
  check_names("target_model", "name", config.target_models, &TargetModelConfig::name, {}, out);
  check_names("target", "name", config.targets, &TargetConfig::name, {}, out);
  check_names("radar", "name", config.radars, &RadarConfig::name, {}, out);
  check_names("array", "name", config.arrays, &ArrayConfig::name, {}, out);
  check_materials(config.materials, out);
  check_arrays(config, out);
  check_trajectories(config, out);
  check_degrees(config, out);
  check_grids(config, out);
  check_targets(config, out);
  check_radars(config, out);
  return out;
}

}  // namespace wavetracer::config
