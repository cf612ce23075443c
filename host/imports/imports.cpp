// SPDX-License-Identifier: Apache-2.0
// Turns a map into a folder: reads, plans, builds, writes and reports.
// A city and its file must fit into memory.
#include "imports/imports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/digits.hpp"
#include "base/file.hpp"
#include "imports/city_model.hpp"
#include "imports/map.hpp"
#include "imports/model_import.hpp"
#include "imports/plan.hpp"
#include "imports/scene_files.hpp"
#include "imports/terrain.hpp"
#include "imports/wall_classes.hpp"
#include "scene/materials.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr size_t first_bytes = 1 << 16;  // comments may come before the root element

void check(const ImportOptions& options) {
  const auto positive = [](const char* what, double value, double most) {
    if (!(value > 0 && value <= most)) {
      throw ConfigError(fmt::format("{} = {} m must be above 0, up to {} m", what, value, most));
    }
  };
  positive("the height of a storey (--level-height)", options.level_height_m, 100);
  positive("the default height (--default-height)", options.default_height_m, 1000);
  if (!(options.margin_m >= 0 && options.margin_m <= 10000)) {
    throw ConfigError(
        fmt::format("the margin of the ground (--margin) = {} m must be from 0 to 10000 m", options.margin_m));
  }
  positive("the error of the terrain (--terrain-error)", options.terrain_error_m, 1000);
  if (!options.terrain.empty() && !options.ground)
    throw ConfigError("--terrain makes the ground that --no-ground leaves out: remove one of them");
  if (options.output.empty()) throw ConfigError("an import needs a folder to write to");
  for (const std::string& name : {options.ground_material, options.wall_material, options.roof_material}) {
    const auto& known = itu_materials();
    if (std::none_of(known.begin(), known.end(), [&](const Material& m) { return m.name == name; })) {
      throw ConfigError(
          fmt::format("'{}' is not an ITU material; materials are, for example, concrete, brick, wood, glass, metal, "
                      "marble and medium_dry_ground",
                      name));
    }
  }
}

bool is_city_model(std::string_view begin) { return imports::is_cityjson(begin) || imports::is_citygml(begin); }

// Tells whether this code reads the file, and not GDAL.
bool is_read_here(std::string_view begin) {
  return imports::is_osm(begin) || imports::is_sumo_polygons(begin) || is_city_model(begin);
}

void refuse_options_of_gdal(const std::string& name, const ImportOptions& options) {
  for (const auto& [flag, value] :
       {std::pair{"--layer", &options.layer}, {"--height", &options.height_field}, {"--levels", &options.levels_field}})
    if (!value->empty())
      throw ConfigError(fmt::format(
          "{}: {} is for maps with fields; this one has heights of its own, which are read anyway", name, flag));
}

void refuse_levels_of_detail(const std::string& name, const ImportOptions& options) {
  if (!options.lod.empty())
    throw ConfigError(
        fmt::format("{}: --lod is for CityJSON and CityGML; a map has footprints, not levels of detail", name));
}

imports::Map read_map(std::string_view content, const std::string& name, const ImportOptions& options) {
  const std::string_view begin = content.substr(0, first_bytes);
  refuse_options_of_gdal(name, options);
  refuse_levels_of_detail(name, options);
  if (imports::is_osm(begin)) return imports::read_osm(content, name, options);
  if (imports::is_sumo_polygons(begin)) return imports::read_sumo_polygons(content, name);
  throw InputError(
      fmt::format("{}: this is neither an OpenStreetMap file (.osm, .osm.pbf), SUMO polygons (.poly.xml), "
                  "CityJSON nor CityGML; unpack .gz, .bz2 and .zip first",
                  name));
}

std::string first_bytes_of(const std::filesystem::path& file) {
  std::string begin(first_bytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<size_t>(in.gcount()));
  return begin;
}

std::string total(const std::map<std::string, uint64_t>& counts) {
  std::string out;
  for (const auto& [reason, count] : counts) out += fmt::format("  {:>7}  {}\n", count, reason);
  return out;
}

// Returns the number that counts the solid.
uint64_t& counted(ImportSummary& summary, const imports::Solid& solid) {
  switch (solid.shape.plant) {
    case imports::Plant::tree:
      return summary.trees;
    case imports::Plant::tree_of_row:
      return summary.trees_of_rows;
    case imports::Plant::wood:
      return summary.woods;
    default:
      return solid.part ? summary.parts : summary.buildings;
  }
}

void add_counts(ImportSummary& summary, const imports::Plan& plan) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  summary.lower_m = glm::dvec2(infinity);
  summary.upper_m = glm::dvec2(-infinity);
  for (const imports::Solid& solid : plan.solids) {
    ++counted(summary, solid);
    summary.courtyards += solid.polygon.holes.size();
    for (const imports::Point& p : solid.polygon.outer) {
      const glm::dvec2 m(static_cast<double>(p.x) / imports::grid_per_m,
                         static_cast<double>(p.y) / imports::grid_per_m);
      summary.lower_m = {std::min(summary.lower_m.x, m.x), std::min(summary.lower_m.y, m.y)};
      summary.upper_m = {std::max(summary.upper_m.x, m.x), std::max(summary.upper_m.y, m.y)};
    }
  }
  summary.left_out = plan.left_out;
  summary.guessed = plan.guessed;
}

// Writes the files of a scene, and fills the summary.
ImportSummary write_city(const std::vector<imports::SceneMesh>& meshes, const Georeference& georeference,
                         ImportSummary summary, const ImportOptions& options) {
  for (const imports::SceneMesh& mesh : meshes) summary.triangles += mesh.triangles.size();
  summary.attribution = georeference.attribution;
  imports::write_scene(meshes, georeference, options);
  summary.scene = options.output / "city.xml";
  summary.net = options.net;
  return summary;
}

// Writes the tables of the wall classes of the scene, unless there are some, which a user may have changed.
void write_wall_tables(const imports::Plan& plan, ImportSummary& summary, const ImportOptions& options) {
  for (const imports::Solid& solid : plan.solids)
    if (imports::find_wall_class(solid.shape.walls)) ++summary.walls[solid.shape.walls];
  std::vector<std::string> names;
  for (const auto& [name, count] : summary.walls) names.push_back(name);
  summary.materials = options.output / "materials.toml";
  const std::string text = imports::wall_tables(names);
  std::error_code error;
  if (!std::filesystem::exists(summary.materials, error)) return write_file(summary.materials, text);
  if (read_file(summary.materials) != text)
    summary.warnings.push_back(
        fmt::format("{}: this file is kept as it is, since you may have changed it; remove it to get the tables anew",
                    summary.materials.string()));
}

ImportSummary import_model(std::string_view content, const std::string& name, const ImportOptions& options) {
  refuse_options_of_gdal(name, options);
  if (options.wall_classes)
    throw ConfigError(
        fmt::format("{}: --wall-classes is for maps of footprints; a city model has no tags of walls", name));
  imports::ModelScene scene = imports::build_model(imports::is_citygml(content.substr(0, first_bytes))
                                                       ? imports::read_citygml(content, name, options)
                                                       : imports::read_cityjson(content, name, options),
                                                   name, options);
  return write_city(scene.meshes, scene.georeference, std::move(scene.summary), options);
}

ImportSummary import_map(const imports::Map& map, const std::string& name, const ImportOptions& options) {
  imports::Plan plan = imports::plan_city(map, name, options);
  Georeference georeference = map.georeference;
  georeference.offset_m += plan.offset_m;
  ImportSummary summary;
  summary.warnings = map.warnings;
  summary.warnings.insert(summary.warnings.end(), plan.warnings.begin(), plan.warnings.end());
  summary.ground = imports::ground_extent(plan, options);
  std::optional<imports::Terrain> terrain;
  if (!options.terrain.empty() && !plan.solids.empty()) {
    terrain = imports::read_terrain(summary.ground, georeference, options);
    imports::stand_on(*terrain->ground, plan);
    summary.terrain = terrain->summary;
    summary.warnings.insert(summary.warnings.end(), terrain->warnings.begin(), terrain->warnings.end());
    georeference.elevation_m = 0;
  }
  add_counts(summary, plan);
  if (plan.solids.empty()) {
    throw InputError(fmt::format("{}: contains no building that can be used{}{}", name,
                                 summary.left_out.empty() ? "" : "; left out:\n", total(summary.left_out)));
  }
  const std::vector<imports::SceneMesh> meshes = imports::build_scene(plan, terrain ? &*terrain : nullptr, options);
  summary.offset_m = plan.offset_m;
  summary.straightened = plan.straightened;
  summary.straightened_by_m = plan.straightened_by_m;
  summary.rounding_m = map.rounding_m;
  summary.tree_columns = map.tree_columns;
  summary = write_city(meshes, georeference, std::move(summary), options);
  if (options.wall_classes) write_wall_tables(plan, summary, options);
  return summary;
}

}  // namespace

bool is_import(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  const std::string begin = first_bytes_of(file);
  const std::string suffix = file.extension().string();
  return is_read_here(begin) || !(begin.empty() || begin.starts_with("\x89HDF") || suffix == ".h5" ||
                                  suffix == ".xml" || suffix == ".toml" || file.filename() == "run.json");
}

bool is_sumo_map(const std::filesystem::path& file) { return imports::is_sumo_polygons(first_bytes_of(file)); }

ImportSummary import_city(const std::filesystem::path& file, const ImportOptions& options) {
  if (is_read_here(first_bytes_of(file))) return import_city(read_file(file), file.string(), options);
  check(options);
  refuse_levels_of_detail(file.string(), options);
  return import_map(imports::read_vector_map(file.string(), options), file.string(), options);
}

ImportSummary import_city(std::string_view content, const std::string& name, const ImportOptions& options) {
  check(options);
  if (is_city_model(content.substr(0, first_bytes))) return import_model(content, name, options);
  return import_map(read_map(content, name, options), name, options);
}

std::string describe(const ImportSummary& s) {
  std::string out = fmt::format(
      "scene      {}\nbuildings  {}, parts {}, courtyards {}; {} triangles\n"
      "extent     {:.0f} x {:.0f} m, from ({:.1f}, "
      "{:.1f}) to ({:.1f}, {:.1f})\n",
      s.scene.string(), grouped(s.buildings), grouped(s.parts), grouped(s.courtyards), grouped(s.triangles),
      s.upper_m.x - s.lower_m.x, s.upper_m.y - s.lower_m.y, s.lower_m.x, s.lower_m.y, s.upper_m.x, s.upper_m.y);
  if (!s.ground.empty())
    out += fmt::format("ground     {:.0f} x {:.0f} m, from ({:.1f}, {:.1f}) to ({:.1f}, {:.1f})\n",
                       s.ground.upper_m.x - s.ground.lower_m.x, s.ground.upper_m.y - s.ground.lower_m.y,
                       s.ground.lower_m.x, s.ground.lower_m.y, s.ground.upper_m.x, s.ground.upper_m.y);
  if (!s.heights.empty()) out += fmt::format("heights    {}\n", s.heights);
  if (s.terrain)
    out += fmt::format(
        "terrain    {} triangles for {} posts, from {:.1f} to {:.1f} m; misses the posts by {:.3f} m at most, "
        "{:.3f} m rms\n",
        grouped(s.terrain->triangles), grouped(s.terrain->posts), s.terrain->lowest_m, s.terrain->highest_m,
        s.terrain->largest_error_m, s.terrain->rms_error_m);
  if (s.trees + s.trees_of_rows + s.woods > 0)
    out += fmt::format(
        "vegetation single trees {}, trees in rows {}, woods {}; they attenuate waves (docs/outdoors.md), and "
        "--no-vegetation leaves them out\n",
        grouped(s.trees), grouped(s.trees_of_rows), grouped(s.woods));
  if (!s.tree_columns.empty()) out += fmt::format("trees      {}\n", s.tree_columns);
  for (const auto& [name, count] : s.walls) out += fmt::format("walls      {} {}\n", name, count);
  if (s.straightened > 0)
    out += fmt::format(
        "straight   {} corners were moved onto the straight walls that they are in, by {:.2g} mm at most: "
        "the map's coordinates are rounded to {:.2g} mm\n",
        grouped(s.straightened), s.straightened_by_m * 1000, 2000 * s.rounding_m);
  if (!s.guessed.empty()) out += "assumed\n" + total(s.guessed);
  if (!s.left_out.empty()) out += "left out\n" + total(s.left_out);
  if (!s.attribution.empty()) out += fmt::format("map data   {}\n", s.attribution);
  out += fmt::format("use it     [scene]\n           file = \"{}\"\n", s.scene.string());
  if (!s.materials.empty())
    out += fmt::format("           # and the [[material]] tables of {}\n", s.materials.string());
  if (!s.net.empty()) out += fmt::format("           streets = \"{}\"\n", s.net.string());
  if (s.offset_m != glm::dvec2(0, 0)) {
    out += fmt::format(
        "           [trajectories]\n           offset_m = [{:.0f}, {:.0f}, 0]  # from the map's coordinates\n",
        s.offset_m.x, s.offset_m.y);
  }
  if (s.terrain)
    out += "           [trajectories]\n           above = \"ground\"  # where the vehicles come from a flat network\n";
  return out;
}

}  // namespace wavetracer
