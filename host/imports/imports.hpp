// Cities of OpenStreetMap (.osm, .osm.pbf), SUMO (.poly.xml) and of maps that GDAL reads as scenes: extruded buildings
// on ground that is flat or follows a raster. City models (CityJSON, CityGML): buildings as they are.
// Nothing is assumed of a file; what cannot be used is left out, counted and reported.
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
  double level_height_m = 3;     // of building:levels
  double default_height_m = 10;  // of buildings without height and levels
  bool ground = true;       // a rectangle at z = 0 under all buildings, the road network (convBoundary) and the traffic
  bool vegetation = false;  // OpenStreetMap only: trees, rows of them and woods as volumes of leaves
  double margin_m = 50;     // ground beyond the outermost of them
  std::string ground_material = "concrete";                            // ITU names
  std::string wall_material = "concrete", roof_material = "concrete";  // where the file does not say
  // OpenStreetMap only: the .net.xml that SUMO's netconvert made of the same map. The scene then has its coordinates,
  // which are those of the vehicles; without it a transverse Mercator projection about the middle of the city.
  std::filesystem::path net;
  Extent traffic;  // where vehicles will be, in the coordinates of the network
  // PROJ string of the coordinates that the scene shall have, instead of that Mercator projection; of a map that does
  // not say where it is, the coordinates that it has.
  std::string projection = {};
  // Maps that GDAL reads only: the layer (empty: all of them), and its fields with heights in m and numbers of storeys.
  std::string layer = {}, height_field = {}, levels_field = {};
  std::string lod = {};  // CityJSON and CityGML only: the highest level of detail; empty: 2
  // A raster of heights that the ground follows and houses stand on; empty: flat at z = 0.
  std::filesystem::path terrain = {};
  double terrain_error_m = 0.3;  // the most by which the ground may miss a post of the raster
  // How far it is: called before each mesh is written, which is what large maps take their time for. May be left out.
  std::function<void(uint64_t done, uint64_t total)> at = {};
};

struct ImportSummary {
  std::filesystem::path scene;               // OUTPUT/city.xml
  std::filesystem::path net;                 // of the options: scene.streets of a configuration
  uint64_t buildings = 0;                    // solids of whole buildings
  uint64_t parts = 0;                        // solids of building:part
  uint64_t vegetation = 0;                   // trees and woods
  std::string heights;                       // of city models: where their ground was and is, in words
  uint64_t courtyards = 0;                   // holes in either
  uint64_t triangles = 0;                    // the ground included
  std::map<std::string, uint64_t> left_out;  // reason -> how many
  std::map<std::string, uint64_t> guessed;   // what was assumed of buildings that stay -> how many
  glm::dvec2 lower_m{0}, upper_m{0};         // of the buildings, in the coordinates of the scene
  Extent ground;                             // empty without one
  glm::dvec2 offset_m{0};        // scene = projected coordinates (OSM) or those of SUMO (.poly.xml, net) + this
  uint64_t straightened = 0;     // corners that were moved onto straight walls, as the map's coordinates are rounded
  double straightened_by_m = 0;  // the farthest of them
  double rounding_m = 0;         // of the map's coordinates
  std::string attribution;       // to be shown with the data; empty where the source asks for none
  struct Terrain {
    uint64_t posts = 0, triangles = 0;            // of the raster in the area of the ground; of the ground
    double largest_error_m = 0, rms_error_m = 0;  // of the ground at these posts
    double lowest_m = 0, highest_m = 0;
  };
  std::optional<Terrain> terrain;
  std::vector<std::string> warnings;
};

// Whether the file is a map that import_city() reads: OSM, SUMO's polygons, CityJSON or CityGML, by its first bytes, or
// what else is no run's HDF5 or JSON file. False for folders and files that are not there.
bool is_import(const std::filesystem::path& file);

// Writes OUTPUT/city.xml, OUTPUT/meshes/*.ply and OUTPUT/georeference.json, the scene file last.
// Throws InputError for the map, ConfigError for options, RuntimeError where nothing can be written.
ImportSummary import_city(const std::filesystem::path& file, const ImportOptions& options);

// The same from memory; `name` stands in messages.
ImportSummary import_city(std::string_view content, const std::string& name, const ImportOptions& options);

// What came out, what was left out, the attribution, and how to use the scene: lines for a terminal.
std::string describe(const ImportSummary& summary);

}  // namespace wavetracer
