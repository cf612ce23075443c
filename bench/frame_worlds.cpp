// SPDX-License-Identifier: Apache-2.0
// Antennas stand around a street crossing; in the drive, vehicles pass them.
#include "frame_worlds.hpp"

#include <fmt/format.h>

#include <functional>
#include <glm/vec3.hpp>

#include "places.hpp"
#include "scene/load.hpp"
#include "street_traffic.hpp"

namespace wavetracer::bench {
namespace {

constexpr size_t transmitters = 4, receivers = 24;
constexpr double step_s = 0.04;

void roughen(Config& config) {
  for (const Material& known : load_scene(config).materials) {
    MaterialConfig& material = config.materials.emplace_back();
    material.name = known.name;
    material.scattering = 0.3;
  }
}

// Adds a grid of crowns around the first transmitter.
void plant(Config& config) {
  const std::array<double, 3> middle = config.transmitters.front().position_m;
  for (int i = -10; i < 10; ++i)
    for (int j = -10; j < 10; ++j) {
      VegetationConfig& crown = config.vegetation.emplace_back();
      crown.centre_m = {middle[0] + 8 * i, middle[1] + 8 * j, 6};
      crown.size_m = {5, 5, 7};
    }
}

void drive(Config& config, size_t vehicles, uint32_t frames) {
  config.time = {.start_s = 0, .end_s = (frames - 1) * step_s, .step_s = step_s};
  StreetTraffic traffic{.vehicles = vehicles, .duration_s = (frames - 1) * step_s};
  for (const SharedList<RadioEnd>* ends : {&config.transmitters, &config.receivers})
    for (const RadioEnd& end : *ends)
      traffic.standing_m.emplace_back(end.position_m[0], end.position_m[1], end.position_m[2]);
  traffic.centre_m = traffic.standing_m.front();
  config.tracks = street_traffic(load_scene(config), traffic);
  config.trace.rays.reset();
  config.trace.diffraction = true;
}

void drive_by_beams(Config& config, size_t vehicles, uint32_t frames) {
  drive(config, vehicles, frames);
  config.trace.discovery = "beams";
  config.trace.diffraction = false;
  config.trace.max_depth = 3;
  config.transmitters.resize(1);
}

void cache(Config& config, bool groups) {
  config.cache.kind = "concurrent";
  config.cache.purge = "precision";
  config.cache.innerframe = groups;
  if (groups) config.cache.division = 100;
}

void spheres(Config& config, bool cached) {
  config.trace.reception = "sphere";
  config.output.waypoints = 1000;
  if (!cached) return;
  cache(config, false);
  config.cache.scope = "all";
}

void diffract(Config& config, uint32_t most) {
  config.trace.diffraction = true;
  config.trace.max_diffractions = most;
  config.trace.max_depth = most == 2 ? 2 : 3;
  config.receivers.resize(most == 2 ? 1 : 8);
  config.transmitters.resize(1);
}

void scatter(Config& config, uint32_t reflections) {
  roughen(config);
  config.transmitters.resize(1);
  config.receivers.resize(2);
  config.trace.scattering = true;
  config.trace.scattering_reflections = reflections;
}

void scatter_behind_edges(Config& config) {
  scatter(config, 1);
  config.trace.diffraction = true;
  config.trace.scattering_diffraction = true;
  config.trace.scattering_floor_db = -150;
}

// Adds a square of small targets around the first transmitter.
void sense(Config& config) {
  constexpr int side = 10;
  config.transmitters.resize(1);
  config.trace.target_reflections = 1;
  config.target_models = {{.name = "drone", .on = "", .kind = "uav-large"}};
  const std::array<double, 3> middle = config.transmitters.front().position_m;
  for (int i = 0; i < side * side; ++i)
    config.targets.push_back(
        {.name = std::to_string(i),
         .model = "drone",
         .position_m = {middle[0] + 7.3 * (i % side - side / 2) + 1.1, middle[1] + 7.3 * (i / side - side / 2) + 1.7,
                        middle[2] + 0.1 * (i % 7)}});
}

// Adds vehicles around the first transmitter, whose bodies scatter.
void scatter_off_bodies(Config& config) {
  config.transmitters.resize(1);
  TargetModelConfig body;
  body.name = "body";
  body.on = "passenger";
  body.kind = "body";
  config.target_models = {body};
  const std::array<double, 3> middle = config.transmitters.front().position_m;
  ParkedConfig cars;
  cars.name = "cars";
  for (int i = 0; i < 4; ++i) cars.places.push_back({middle[0] + 6 * i - 9, middle[1] + 6, 0, 30.0 * i});
  config.parked = {cars};
}

// The same with waves that bounce between two facets of a body.
void bounce_in_bodies(Config& config) {
  scatter_off_bodies(config);
  config.target_models[0].bounces = 2;
}

void sense_behind_edges(Config& config) {
  sense(config);
  diffract(config, 1);
  config.trace.target_diffraction = true;
}

// Adds a square of cells around the first transmitter.
void add_map(Config& config, double side_m, double cell_m) {
  const std::array<double, 3> middle = config.transmitters.front().position_m;
  ReceiverGridConfig& grid = config.receiver_grids.emplace_back();
  grid.name = "map";
  grid.x_min_m = middle[0] - side_m / 2;
  grid.x_max_m = middle[0] + side_m / 2;
  grid.y_min_m = middle[1] - side_m / 2;
  grid.y_max_m = middle[1] + side_m / 2;
  grid.step_m = cell_m;
}

}  // namespace

std::vector<FrameWorld> frame_worlds(const std::string& shared, uint64_t rays, size_t vehicles, uint32_t frames) {
  const std::optional<Place> munich = munich_place(shared, transmitters, receivers);
  Config common = config_of(munich ? *munich : city_place(transmitters, receivers), transmitters, receivers);
  common.trace.rays = rays;
  std::vector<FrameWorld> worlds;
  const auto add = [&](const char* name, const std::function<void(Config&)>& change, uint32_t count = 1) {
    worlds.push_back({name, common, count});
    change(worlds.back().config);
  };
  add("reflections", [](Config&) {});
  add("ordered", [](Config& c) {
    c.order.method = "morton";
    c.order.each_depth = true;
    c.trace.directions = "random";
  });
  add("refined", [](Config& c) { c.trace.rays.reset(); });
  add("beams", [](Config& c) {
    c.trace.discovery = "beams";
    c.trace.max_depth = 3;
    c.transmitters.resize(1);
  });
  add(
      "kept beams", [&](Config& c) { drive_by_beams(c, vehicles, frames); }, frames);
  add("transmission", [](Config& c) { c.trace.transmission = true; });
  add("vegetation", plant);
  add("scattering", [](Config& c) { scatter(c, 0); });
  add("scattering by mirrors", [](Config& c) { scatter(c, 1); });
  add("scattering behind edges", scatter_behind_edges);
  add("crowns", [](Config& c) {
    plant(c);
    MaterialConfig& leaves = c.materials.emplace_back();
    leaves.name = "vegetation";
    leaves.vegetation = "mixed";
    leaves.scattering = 0.5;
    c.trace.scattering = true;
  });
  add("targets", sense);
  add("targets behind edges", sense_behind_edges);
  add("bodies", scatter_off_bodies);
  add("bounces", bounce_in_bodies);
  add("diffraction", [](Config& c) { diffract(c, 1); });
  add("edge rays", [](Config& c) {
    diffract(c, 1);
    c.trace.edge_rays = 256;
  });
  add("sums", [](Config& c) {
    diffract(c, 1);
    add_map(c, 300, 6);
    c.trace.edge_rays = 256;
    c.output.paths = false;
  });
  add("two diffractions", [](Config& c) { diffract(c, 2); });
  add(
      "drive", [&](Config& c) { drive(c, vehicles, frames); }, frames);
  add("cache", [](Config& c) { cache(c, false); });
  add("groups of a cache", [](Config& c) { cache(c, true); });
  add("spheres", [](Config& c) { spheres(c, false); });
  add("spheres of a cache", [](Config& c) { spheres(c, true); });
  return worlds;
}

}  // namespace wavetracer::bench
