// SPDX-License-Identifier: Apache-2.0
// A map as its reader returns it: footprints with tags, in the coordinates that the scene will have.
// Coordinates of rings are finite; imports/rings.hpp checks the rest.
#pragma once
#include <glm/vec2.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "imports/building_tags.hpp"
#include "imports/imports.hpp"
#include "scene/georeference.hpp"

namespace wavetracer::imports {

using RingM = std::vector<glm::dvec2>;  // m; the first point may be repeated at the end

struct Footprint {
  std::string id;    // such as "way_123": unique, and valid as a file name
  std::string name;  // the name that people use; may be empty
  RingM outer;
  std::vector<RingM> holes;
  Tags tags;
};

struct Map {
  std::vector<Footprint> footprints;
  Georeference georeference;  // reference of the footprints' coordinates; it has no projection if none is known
  Extent network;             // convBoundary of SUMO's <location>
  // Largest error of a coordinate, because the file has few digits: half of the last digit's step.
  double rounding_m = 0;
  bool nested_are_courtyards = false;  // a footprint inside another one with the same tags is a hole in it
  std::map<std::string, uint64_t> left_out;
  std::string tree_columns;  // in words: the fields that trees have their sizes from; empty without such trees
  std::vector<std::string> warnings;
};

constexpr std::string_view osm_attribution =
    "(c) OpenStreetMap contributors, Open Database License 1.0, https://www.openstreetmap.org/copyright";

bool is_osm(std::string_view first_bytes);
bool is_sumo_polygons(std::string_view first_bytes);

// Both throw InputError that names the file and the place in it.
Map read_osm(std::string_view content, const std::string& name, const ImportOptions& options);
Map read_sumo_polygons(std::string_view content, const std::string& name);
// Reads a map in one of the formats of GDAL. Throws InputError for the map, RuntimeError if GDAL is missing.
Map read_vector_map(const std::string& file, const ImportOptions& options);

// The <location> of a .net.xml or .poly.xml.
struct SumoLocation {
  Georeference georeference;
  // Bounds of the network or the polygons, in its coordinates; empty if SUMO says that there is nothing.
  Extent boundary;
};
// Returns nothing if there is none. Throws InputError if it is malformed.
std::optional<SumoLocation> sumo_location(std::string_view content, const std::string& name);

// Returns "NAME:LINE" for a byte of the text.
std::string line_of(std::string_view content, std::ptrdiff_t offset, const std::string& name);

// Returns the name of the root element of an XML text, of which the beginning is enough; empty if there is none.
std::string_view root_element(std::string_view text);

}  // namespace wavetracer::imports
