// From a map to a folder: read, plan, build, write, say.
// Assumes that a city and its file fit into memory.
#include "imports/imports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/file.hpp"
#include "imports/map.hpp"
#include "imports/plan.hpp"
#include "imports/scene_files.hpp"
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

imports::Map read_map(std::string_view content, const std::string& name, const ImportOptions& options) {
  const std::string_view begin = content.substr(0, first_bytes);
  if (imports::is_osm(begin)) return imports::read_osm(content, name, options);
  if (imports::is_sumo_polygons(begin)) return imports::read_sumo_polygons(content, name);
  throw InputError(
      fmt::format("{}: this is neither an OpenStreetMap file (.osm, .osm.pbf) nor a file of SUMO polygons (.poly.xml); "
                  "unpack .gz and .bz2 first",
                  name));
}

std::string total(const std::map<std::string, uint64_t>& counts) {
  std::string out;
  for (const auto& [reason, count] : counts) out += fmt::format("  {:>7}  {}\n", count, reason);
  return out;
}

void add_counts(ImportSummary& summary, const imports::Plan& plan) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  summary.lower_m = glm::dvec2(infinity);
  summary.upper_m = glm::dvec2(-infinity);
  for (const imports::Solid& solid : plan.solids) {
    ++(!solid.is_building() ? summary.vegetation : solid.part ? summary.parts : summary.buildings);
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

void write_reference(const std::filesystem::path& folder, const Georeference& georeference) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RuntimeError(fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  const std::filesystem::path file = folder / "georeference.json";
  if (georeference.projection.empty()) {
    std::filesystem::remove(file, error);  // of an earlier import
  } else {
    write_georeference(file, georeference);
  }
}

}  // namespace

bool is_import(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  std::string begin(first_bytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<size_t>(in.gcount()));
  return imports::is_osm(begin) || imports::is_sumo_polygons(begin);
}

ImportSummary import_city(const std::filesystem::path& file, const ImportOptions& options) {
  return import_city(read_file(file), file.string(), options);
}

ImportSummary import_city(std::string_view content, const std::string& name, const ImportOptions& options) {
  check(options);
  const imports::Map map = read_map(content, name, options);
  const imports::Plan plan = imports::plan_city(map, name, options);
  ImportSummary summary;
  add_counts(summary, plan);
  if (plan.solids.empty()) {
    throw InputError(fmt::format("{}: contains no building that can be used{}{}", name,
                                 summary.left_out.empty() ? "" : "; left out:\n", total(summary.left_out)));
  }
  const std::vector<imports::SceneMesh> meshes = imports::build_scene(plan, options);
  for (const imports::SceneMesh& mesh : meshes) summary.triangles += mesh.triangles.size();
  Georeference georeference = map.georeference;
  georeference.offset_m += plan.offset_m;
  summary.offset_m = plan.offset_m;
  summary.ground = imports::ground_extent(plan, options);
  summary.attribution = georeference.attribution;
  summary.warnings = map.warnings;
  write_reference(options.output, georeference);
  imports::write_scene(meshes, options, georeference.attribution);
  summary.scene = options.output / "city.xml";
  summary.net = options.net;
  return summary;
}

std::string describe(const ImportSummary& s) {
  std::string out = fmt::format(
      "scene      {}\nbuildings  {}, parts {}, courtyards {}; {} triangles\nextent     {:.0f} x {:.0f} m, from "
      "({:.1f}, "
      "{:.1f}) to ({:.1f}, {:.1f})\n",
      s.scene.string(), s.buildings, s.parts, s.courtyards, s.triangles, s.upper_m.x - s.lower_m.x,
      s.upper_m.y - s.lower_m.y, s.lower_m.x, s.lower_m.y, s.upper_m.x, s.upper_m.y);
  if (!s.ground.empty())
    out += fmt::format("ground     {:.0f} x {:.0f} m, from ({:.1f}, {:.1f}) to ({:.1f}, {:.1f})\n",
                       s.ground.upper_m.x - s.ground.lower_m.x, s.ground.upper_m.y - s.ground.lower_m.y,
                       s.ground.lower_m.x, s.ground.lower_m.y, s.ground.upper_m.x, s.ground.upper_m.y);
  if (s.vegetation > 0) out += fmt::format("vegetation {} trees and woods, by docs/outdoors.md\n", s.vegetation);
  if (!s.guessed.empty()) out += "assumed\n" + total(s.guessed);
  if (!s.left_out.empty()) out += "left out\n" + total(s.left_out);
  if (!s.attribution.empty()) out += fmt::format("map data   {}\n", s.attribution);
  out += fmt::format("use it     [scene]\n           file = \"{}\"\n", s.scene.string());
  if (!s.net.empty()) out += fmt::format("           streets = \"{}\"\n", s.net.string());
  if (s.offset_m != glm::dvec2(0, 0)) {
    out += fmt::format(
        "           [trajectories]\n           offset_m = [{:.0f}, {:.0f}, 0]  # from the map's coordinates\n",
        s.offset_m.x, s.offset_m.y);
  }
  return out;
}

}  // namespace wavetracer
