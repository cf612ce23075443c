// SPDX-License-Identifier: Apache-2.0
#include "radio/field_tables.hpp"

#include <fmt/format.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radio/air.hpp"
#include "radio/antenna.hpp"
#include "radio/cells.hpp"
#include "radio/constants.hpp"
#include "radio/material_table.hpp"
#include "scene/tiles.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

void add_antennas(FieldTables& tables, const Config& config) {
  tables.transmitters = static_cast<uint32_t>(config.transmitters.size());
  const auto add = [&](const RadioEnd& end, uint32_t& ports) {
    const Antenna antenna = make_antenna(end);
    ports = std::max(ports, antenna.ports());
    tables.antennas.push_back(antenna.record());
    tables.antennas.back().first_sample = static_cast<uint32_t>(tables.samples.size() / 4);
    tables.samples.insert(tables.samples.end(), antenna.samples().begin(), antenna.samples().end());
  };
  for (const RadioEnd& end : config.transmitters) add(end, tables.ports.tx);
  for (const RadioEnd& end : config.receivers) add(end, tables.ports.rx);
}

// Adds the cells after the tiles.
void add_cells(FieldTables& tables, const Scene& scene, double cell_m) {
  const std::vector<Cell> cells = make_cells(scene, cell_m, TileTable::most_tiles - tables.surface_of_tile.size());
  const size_t first = scene.surfaces.size();
  if (!cells.empty() && first + scene.volumes.size() > WT_CELL_NUMBER)
    throw ConfigError(
        fmt::format("the scene has {} surfaces and {} volumes of vegetation, too many for scattering off "
                    "vegetation: at most {} are possible",
                    first, scene.volumes.size(), WT_CELL_NUMBER));
  for (const Cell& cell : cells) {
    const uint32_t kind = tables.volumes.volumes[cell.volume].kind;
    tables.surface_of_tile.push_back(WT_CELL | kind << WT_CELL_KIND_SHIFT | static_cast<uint32_t>(first + cell.volume));
    tables.area_of_tile.push_back(std::cbrt(cell.volume_m3));
  }
  tables.cells = static_cast<uint32_t>(cells.size());
}

// Gives pieces of bodies the materials of their surfaces, which all instances of a model have in common.
void set_materials(FieldTables& tables, std::span<const Instance> instances) {
  for (const std::vector<TargetLaws::BodyLaws>& bodies : tables.targets.bodies)
    for (size_t model = 0; model < bodies.size(); ++model) {
      const auto instance = std::ranges::find(instances, model, &Instance::model);
      if (instance == instances.end()) continue;
      for (size_t i = 0; i < bodies[model].pieces.size(); ++i)
        tables.targets.facets[tables.targets.laws[bodies[model].first_law + i].first_lobe].material =
            tables.materials_of[instance->first_surface + bodies[model].pieces[i].surface];
    }
}

bool has_corners(const Scene& scene) {
  return std::ranges::any_of(scene.wedges, [](const Wedge& wedge) { return wedge.exterior_rad < std::numbers::pi; });
}

}  // namespace

FieldTables make_field_tables(const Scene& scene, const Config& config, std::span<const Scene> models,
                              std::span<const Instance> instances) {
  FieldTables tables;
  tables.wavelength_m = speed_of_light_m_s / config.radio.frequency_hz;
  tables.seed = config.trace.seed;
  if (config.trace.reflection) tables.reflections = config.trace.max_depth;
  if (config.trace.transmission)
    tables.transmissions = std::min(config.trace.max_transmissions, config.trace.max_depth);
  MaterialTable table = make_material_table(scene, models, instances, config.radio.frequency_hz);
  tables.materials = std::move(table.materials);
  tables.materials_of = std::move(table.materials_of);
  tables.names = std::move(table.names);
  tables.walls = std::move(table.walls);
  add_antennas(tables, config);
  tables.air = air_at(config.air, config.radio.frequency_hz);
  tables.volumes = volume_table(scene);
  tables.foliages = foliages_at(tables.volumes, scene, config.radio.frequency_hz);
  tables.edge_ends = std::ranges::any_of(scene.wedges, [](const Wedge& wedge) { return wedge.free_ends != 0; });
  tables.corners = has_corners(scene) || std::ranges::any_of(models, has_corners);
  if (config.trace.target) {
    tables.targets = target_laws(config.target_models, config.target_parts, models);
    set_materials(tables, instances);
  }
  tables.reflects_echoes =
      config.trace.reflects_echoes() ||
      (config.trace.target && std::ranges::any_of(config.target_models, &TargetModelConfig::bounces_within));
  tables.scatters = config.trace.scattering;
  tables.reflects_scattered = config.trace.reflects_scattered();
  tables.bends_scattered = config.trace.scattering_diffraction;
  if (!tables.scatters) return tables;
  const TileTable tiles(scene, models, instances, config.trace.tile_m);
  for (uint32_t id = 0; id < tiles.size(); ++id) {
    const TilePlace place = tiles.at(id);
    tables.surface_of_tile.push_back(tiles.surface(place));
    tables.area_of_tile.push_back(tiles.tile(place).area_m2);
  }
  add_cells(tables, scene, config.trace.tile_m);
  return tables;
}

std::vector<device::wt_field_end> field_ends(std::span<const EndState> ends, uint32_t first_antenna) {
  std::vector<device::wt_field_end> records(ends.size());
  tbb::parallel_for(size_t{0}, ends.size(), [&](size_t i) {
    device::wt_field_end& record = records[i];
    for (int row = 0; row < 3; ++row) {
      record.position_m[row] = ends[i].position_m[row];
      record.velocity_m_s[row] = ends[i].velocity_m_s[row];
      for (int column = 0; column < 3; ++column) record.rotation[3 * row + column] = ends[i].rotation[column][row];
    }
    record.antenna = first_antenna + static_cast<uint32_t>(i);
  });
  return records;
}

}  // namespace wavetracer
