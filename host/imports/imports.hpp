// SPDX-License-Identifier: Apache-2.0
// Imports cities of OpenStreetMap (.osm, .osm.pbf), SUMO (.poly.xml) and maps that GDAL reads as scenes: extruded
// buildings on ground that is flat or follows a raster. City models (CityJSON, CityGML) keep their buildings' shapes.
// Files are not trusted; objects that cannot be used are left out, counted and reported.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

// A rectangle seen from above; one without a point is empty.
struct Extent {
  glm::dvec2 lower_m{std::numeric_limits<double>::infinity()}, upper_m{-std::numeric_limits<double>::infinity()};
  bool empty() const { return !(lower_m.x <= upper_m.x && lower_m.y <= upper_m.y); }
  void add(const glm::dvec2& p) {
    lower_m = glm::min(lower_m, p);
    upper_m = glm::max(upper_m, p);
  }
};

struct ImportOptions {
  std::filesystem::path output;  // folder; created
  double level_height_m = 3;     // height of a level, for building:levels
  double default_height_m = 10;  // height of buildings without height and levels
  bool ground = true;  // adds a rectangle at z = 0 below all buildings, the road network (convBoundary) and the traffic
  bool vegetation = true;                    // adds trees, rows of trees and woods of the map as volumes of leaves
  double margin_m = 50;                      // ground beyond the outermost objects
  std::string ground_material = "concrete";  // ITU names
  std::string wall_material = "concrete", roof_material = "concrete";  // used where the file does not name a material
  // Maps of footprints: walls have classes with a thickness and a roughness, whose tables are written to
  // materials.toml.
  bool wall_classes = false;
  // OpenStreetMap only: the .net.xml that SUMO's netconvert made of the same map. The scene then has its coordinates,
  // which are those of the vehicles; without it, a transverse Mercator projection about the middle of the city is used.
  std::filesystem::path net;
  Extent traffic;  // area where vehicles will be, in the coordinates of the network
  // PROJ string of the scene's coordinates, instead of that Mercator projection; for a map without a coordinate system,
  // the coordinates that it has.
  std::string projection = {};
  // For maps that GDAL reads only: the layer (empty: all), and its fields with heights in m and numbers of storeys.
  std::string layer = {}, height_field = {}, levels_field = {};
  std::string lod = {};  // CityJSON and CityGML only: the highest level of detail; empty: "2"
  // A raster of heights that the ground follows and houses stand on; empty: the ground is flat at z = 0.
  std::filesystem::path terrain = {};
  double terrain_error_m = 0.3;  // largest error of the ground at a post of the raster
  // Reports progress: called before each mesh is written, which takes most of the time for large maps. It may be empty.
  std::function<void(uint64_t done, uint64_t total)> at = {};
};

struct ImportSummary {
  std::filesystem::path scene;            // OUTPUT/city.xml
  std::filesystem::path materials;        // OUTPUT/materials.toml; empty without wall classes
  std::map<std::string, uint64_t> walls;  // number of solids of each wall class
  std::filesystem::path net;              // the network of the options: scene.streets of a configuration
  uint64_t buildings = 0;                 // number of solids of whole buildings
  uint64_t parts = 0;                     // number of solids of building:part
  uint64_t trees = 0, trees_of_rows = 0, woods = 0;
  std::string tree_columns;                  // for trees of a map of GDAL: the fields of their sizes, in words
  std::string heights;                       // for city models: the old and new height of their ground, in words
  uint64_t courtyards = 0;                   // number of holes in either
  uint64_t triangles = 0;                    // includes the ground
  std::map<std::string, uint64_t> left_out;  // number of objects left out, by reason
  std::map<std::string, uint64_t> guessed;   // number of values that were assumed for buildings, by kind
  glm::dvec2 lower_m{0}, upper_m{0};         // bounds of the buildings, in the coordinates of the scene
  Extent ground;                             // empty if there is no ground
  // Scene coordinates = projected coordinates (OSM) or those of SUMO (.poly.xml, net) + offset_m.
  glm::dvec2 offset_m{0};
  // Number of corners that were moved onto straight walls, since the map's coordinates are rounded.
  uint64_t straightened = 0;
  double straightened_by_m = 0;  // the largest move
  double rounding_m = 0;         // rounding of the map's coordinates
  std::string attribution;       // text that must be shown with the data; empty if the source requires none
  struct Terrain {
    uint64_t posts = 0, triangles = 0;  // posts of the raster in the area of the ground; triangles of the ground
    double largest_error_m = 0, rms_error_m = 0;  // error of the ground at these posts
    double lowest_m = 0, highest_m = 0;
  };
  std::optional<Terrain> terrain;
  std::vector<std::string> warnings;
};

// Tells whether the file is a map that import_city() reads: OSM, SUMO's polygons, CityJSON or CityGML, recognised by
// the first bytes, or any other file that is not HDF5 or JSON of a run. Returns false for folders and missing files.
bool is_import(const std::filesystem::path& file);

// Tells whether the map has polygons of SUMO, whose coordinates are those of their network.
bool is_sumo_map(const std::filesystem::path& file);

// Writes OUTPUT/city.xml, OUTPUT/meshes/*.ply and OUTPUT/georeference.json, the scene file last.
// Throws InputError for the map, ConfigError for options, RuntimeError if a file cannot be written.
ImportSummary import_city(const std::filesystem::path& file, const ImportOptions& options);

// Does the same from memory; messages use `name`.
ImportSummary import_city(std::string_view content, const std::string& name, const ImportOptions& options);

// Returns lines for a terminal: what was made, what was left out, the attribution, and how to use the scene.
std::string describe(const ImportSummary& summary);

}  // namespace wavetracer
