// SPDX-License-Identifier: Apache-2.0
// Makes configurations from configurations.
// The built-in city's traffic is generated with the city's own options.
#include "study/worlds.hpp"
#include <fmt/format.h>
#include <cmath>
#include "study/experiment.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

constexpr uint32_t vehicles = 20, senders = 3;
constexpr double default_speed_m_s = 13.9;  // 50 km/h
constexpr const char* rider = "driven transmitter";

TimeConfig frame_times(uint64_t frames) {
  return {.start_s = 0.0, .end_s = frame_step_s * static_cast<double>(frames), .step_s = frame_step_s};
}

MountConfig roof(const std::string& name, const std::string& role) {
  MountConfig mount;
  mount.name = name;
  mount.role = MountRole::named(role);
  mount.offset_m = {0, 0, 1.6};
  return mount;
}

// Receivers on the pavements of four streets of the built-in city, so that errors are means over tens of paths and
// more: two receivers and the roofs get a few.
void add_walkers(Config& config) {
  constexpr double pavement_m = 7, height_m = 1.5, step_m = 7.5, street_m = 97.5;
  const auto add = [&](double x, double y) {
    RadioEnd end;
    end.name = fmt::format("walker-{}", config.receivers.size());
    end.position_m = {x, y, height_m};
    config.receivers.push_back(end);
  };
  for (int k = -12; k <= 12; ++k) {
    if (k == 0) continue;
    for (const double street : {-street_m, 0.0, street_m}) add(step_m * k, street + pavement_m);
    add(pavement_m, step_m * k);
  }
}

}  // namespace

bool has_vehicles(const Config& config) {
  return !config.tracks.empty() || !config.trajectories.file.empty() || !config.trajectories.generate.empty();
}

Config with_traffic(const Config& city, const std::string& drive, uint64_t frames) {
  Config config = city;
  config.time = frame_times(frames);
  config.trajectories.generate = fmt::format("{} --vehicles {} --seconds {:g} --step 0.1", city.scene.generate,
                                             vehicles, std::ceil(*config.time.end_s) + 1);
  config.mounts.push_back(roof("roof", "receiver"));
  add_walkers(config);
  if (drive == "spheres" || drive == "thesis") config.trace.reception = "sphere";
  if (drive == "fixed" || drive == "spheres") return config;
  config.transmitters.clear();
  for (uint32_t i = 0; i < senders; ++i) {
    config.mounts.push_back(roof("sender", "transmitter"));
    config.mounts.back().name += std::to_string(i);
    config.mounts.back().on = fmt::format("veh{}", i);
  }
  return config;
}

Config driven(const Config& asked, uint64_t frames) {
  Config standing = asked;  // stations send and receive: the first of all transmitters is the one that moves
  standing.transmitters.insert(standing.transmitters.end(), asked.stations.begin(), asked.stations.end());
  standing.receivers.insert(standing.receivers.end(), asked.stations.begin(), asked.stations.end());
  standing.stations.clear();
  if (standing.transmitters.empty())
    throw ConfigError(
        fmt::format("{}nothing that sends can be driven: give a [[transmitter]] or a [[station]], "
                    "or vehicles with antennas ([[mount]]) and their trajectories",
                    standing.file.empty() ? "" : standing.file + ": "));
  const RadioEnd& end = standing.transmitters.front();
  Config config = standing;
  config.time = frame_times(frames);
  config.vehicle_types.push_back({.name = rider, .model = "none"});
  std::array<double, 3> velocity_m_s = end.velocity_m_s;
  if (std::hypot(velocity_m_s[0], velocity_m_s[1], velocity_m_s[2]) == 0) velocity_m_s = {default_speed_m_s, 0, 0};
  const double last_s = *config.time.end_s;
  const auto& [x, y, z] = end.position_m;
  config.tracks.push_back({.id = end.name,
                           .type = rider,
                           .waypoints = {{0, x, y, z},
                                         {last_s, x + last_s * velocity_m_s[0], y + last_s * velocity_m_s[1],
                                          z + last_s * velocity_m_s[2]}}});
  config.mounts = {{.name = end.name,
                    .on = end.name,
                    .role = "transmitter",
                    .offset_m = {0, 0, 0},
                    .antenna = end.antenna,
                    .polarization = end.polarization,
                    .orientation_deg = end.orientation_deg}};
  config.transmitters.clear();
  config.links.transmitters = {"*"};  // the end has another name now, and belongs to a vehicle
  config.links.v2i = config.links.i2i;
  return config;
}

Config moving_world(const Config& config, const std::string& drive_of_city, uint64_t frames) {
  if (has_vehicles(config)) return config;
  return config.file == built_in_city_name ? with_traffic(config, drive_of_city, frames) : driven(config, frames);
}

}  // namespace wavetracer::study
