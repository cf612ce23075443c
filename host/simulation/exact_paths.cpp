// SPDX-License-Identifier: Apache-2.0
// Geometry decides: this chooses the passes that a configuration needs, and one of the two that check legs.
#include "simulation/exact_paths.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "radio/scattering.hpp"
#include "radio/world_records.hpp"
#include "simulation/tracing_depth.hpp"

namespace wavetracer {

namespace {

// The number of tiles whose centres fit into a buffer of the device, and that take at most half of the memory of the
// machine while they are made, about 110 bytes each.
uint64_t fitting_tiles(const gpu::DeviceInfo& device) {
  const auto memory = static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  return std::min({TileTable::most_tiles, device.max_buffer / (3 * sizeof(double)), memory / 2 / 110});
}

uint32_t surface_count(const Scene& scene, const World& world) {
  size_t count = scene.surfaces.size();
  for (const Instance& instance : world.fleet.instances) count += world.fleet.models[instance.model].surfaces.size();
  return static_cast<uint32_t>(count);
}

// The gain of paths over the tile whose parts before and after it are 1 m long, if all reflections are perfect and the
// tile is turned the best way.
double power_of_tile(const Material& material, double area_m2, double wavelength_m) {
  const double at_1_m = wavelength_m / (4 * std::numbers::pi);
  const double amplitude = at_1_m * material.scattering;
  return amplitude * amplitude * area_m2 * strongest_pattern(static_cast<uint32_t>(material.scattering_lobe));
}

JoinedPoints limits_of(const TraceConfig& trace) {
  return {.max_depth = trace.max_depth,
          .transmissions = trace.transmission ? trace.max_transmissions : 0,
          .row_depth = tracing_depth(trace).row};
}

JoinedPoints joined_points(const Scene& scene, const World& world, const TileTable& tiles, const TraceConfig& trace,
                           double longest_wavelength_m) {
  constexpr double rounding = 1e-9;
  JoinedPoints out = limits_of(trace);
  if (!trace.scattering_floor_db) return out;
  out.floor = std::pow(10.0, *trace.scattering_floor_db / 10) * (1 - rounding);
  for (uint32_t id = 0; id < tiles.size(); ++id) {
    const TilePlace place = tiles.at(id);
    const Scene& of = place.part == 0 ? scene : world.fleet.models[place.part - 1];
    const Tile& tile = tiles.tile(place);
    out.powers.push_back(
        power_of_tile(of.materials[of.surfaces[tile.surface].material], tile.area_m2, longest_wavelength_m));
  }
  return out;
}

// Bounds of the gains of paths over each point.
std::vector<double> powers_of(const Targets& targets, double longest_wavelength_m) {
  std::vector<double> out;
  for (const TargetPoint& point : targets.points) out.push_back(point.power(longest_wavelength_m));
  return out;
}

// Gain below which a path over a target may be left out; 0: none is.
double target_floor(const TraceConfig& trace) {
  constexpr double rounding = 1e-9;
  return trace.target_floor_db ? std::pow(10.0, *trace.target_floor_db / 10) * (1 - rounding) : 0;
}

}  // namespace

ExactPaths::ExactPaths(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, const World& world,
                       const TraceConfig& trace, double longest_wavelength_m, bool frames_follow)
    : max_depth(trace.max_depth),
      candidates(context, tracing_depth(trace).reflections),
      solve(context, tracing_depth(trace).row, frames_follow && !trace.transmission),
      visible(context, tracing_depth(trace).row) {
  const TracingDepth depth = tracing_depth(trace);
  if (frames_follow && !trace.transmission) blockers.emplace(context);
  if (trace.diffraction) {
    const BendFloors floors = bend_floors(trace.diffraction_floor_db, longest_wavelength_m, trace.transmission);
    std::optional<WedgePairs> two;
    if (trace.max_diffractions > 1) two.emplace(context, device_scene, scene, trace.transmission, floors);
    diffraction.emplace(context, Wedges(context, scene, world.fleet.models, world.fleet.instances, trace.free_edges),
                        trace.max_depth, depth.row, longest_wavelength_m, floors, std::move(two), frames_follow);
    if (trace.from_edges())
      diffraction->heard.emplace(HeardEdges{{context, device_scene, scene, false, most_pieces},
                                            {context, trace.max_depth, most_pieces, longest_wavelength_m}});
    if (depth.edges > 1) {
      const auto instances = static_cast<uint32_t>(world.fleet.instances.size());
      const WedgeGrid grid(wedge_records(scene, world.fleet.models, world.fleet.instances),
                           static_cast<uint32_t>(scene.wedges.size()), instances, trace.free_edges);
      diffraction->chains.emplace(context, grid, depth.edges, depth.row, longest_wavelength_m);
    }
  }
  if (trace.scattering) add_scattering(context, scene, world, trace, longest_wavelength_m);
  if (trace.target) add_targets(context, world, trace, longest_wavelength_m);
  if (trace.transmission)
    transmissions.emplace(context, device_scene, std::min(trace.max_transmissions, trace.max_depth), trace.max_depth);
  else
    occlusion.emplace(context, device_scene);
}

void ExactPaths::add_scattering(gpu::Context& context, const Scene& scene, const World& world, const TraceConfig& trace,
                                double longest_wavelength_m) {
  const TileTable tiles(scene, world.fleet.models, world.fleet.instances, trace.tile_m, fitting_tiles(context.info()));
  const uint32_t row_depth = tracing_depth(trace).row;
  if (tiles.size() > 0) scatter.emplace(context, tiles, surface_count(scene, world), row_depth);
  if (scatter && trace.scattering_reflections > 0) {
    const uint32_t most = std::min(trace.scattering_reflections, trace.max_depth - 1);
    const JoinedPoints limits = joined_points(scene, world, tiles, trace, longest_wavelength_m);
    scattered.emplace(context, most, limits, trace.scattering_diffraction);
    if (trace.scattering_diffraction)
      scattered_edges = std::make_unique<ScatteredEdges>(context, tiles, most, limits,
                                                         bent_waves(longest_wavelength_m, trace.transmission));
  }
  const std::vector<Cell> cells = make_cells(scene, trace.tile_m, TileTable::most_tiles - tiles.size());
  if (!cells.empty()) crowns.emplace(context, cells, tiles.size(), row_depth);
}

void ExactPaths::add_targets(gpu::Context& context, const World& world, const TraceConfig& trace,
                             double longest_wavelength_m) {
  const double floor = target_floor(trace);
  const std::vector<double> powers = floor > 0 ? powers_of(world.targets, longest_wavelength_m) : std::vector<double>{};
  const std::vector<uint32_t> bodies = body_instances(world.targets, world.fleet);
  if (!bodies.empty()) target_bodies.emplace(context, bodies);
  targets.emplace(context, static_cast<uint32_t>(world.targets.points.size()), tracing_depth(trace).row,
                  TargetLimits{.floor = floor, .powers = powers, .sides = !bodies.empty()});
  if (!world.targets.bounces.empty()) target_bounces.emplace(context, world.targets.bounces, tracing_depth(trace).row);
  if (trace.target_reflections == 0) return;
  JoinedPoints limits = limits_of(trace);
  limits.floor = floor;
  limits.powers = powers;
  if (trace.target_diffraction) limits.diffractions = trace.max_diffractions;
  target_chains = std::make_unique<TargetChains>(context, std::min(trace.target_reflections, trace.max_depth - 1),
                                                 std::move(limits), longest_wavelength_m);
}

void ExactPaths::check_legs(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, Counters& counters,
                            bool remember) {
  const StepTables steps{diffraction ? &diffraction->wedges.list().wedges : nullptr,
                         scatter ? &scatter->tiles().surfaces : nullptr, targets ? &targets->points() : nullptr};
  if (target_bodies) (*target_bodies)(scene, solved, counters, steps, *targets);
  if (transmissions)
    (*transmissions)(scene, ends, solved, counters, steps);
  else
    (*occlusion)(scene, ends, solved, counters, blockers && remember && !solved.open ? &*blockers : nullptr, steps);
}

void ExactPaths::place_targets(const WorldState& world, const std::vector<uint32_t>& listeners) {
  if (!targets) return;
  targets->place(world);
  if (!target_chains) return;
  std::vector<EndState> launching = world.transmitters;
  for (const uint32_t receiver : listeners) launching.push_back(world.receivers[receiver]);
  target_chains->place(launching, world.targets);
}

}  // namespace wavetracer
