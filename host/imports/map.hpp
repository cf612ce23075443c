// A map as its reader hands it over: footprints with tags, in the coordinates that the scene will have.
// Assumes nothing of the rings but finite coordinates: imports/rings.hpp checks them.
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
  std::string id;    // "way_123", unique, fit for a file name
  std::string name;  // as people call it, may be empty
  RingM outer;
  std::vector<RingM> holes;
  Tags tags;
};

struct Map {
  std::vector<Footprint> footprints;
  Georeference georeference;  // of the coordinates of the footprints; without a projection where none is known
  Extent network;             // convBoundary of SUMO's <location>
  double rounding_m = 0;      // how far a coordinate may be off, because the file holds few digits: half of a step
  bool nested_are_courtyards = false;  // a footprint inside another of the same tags is a hole in it
  std::map<std::string, uint64_t> left_out;
  std::vector<std::string> warnings;
};

constexpr std::string_view osm_attribution =
    "(c) OpenStreetMap contributors, Open Database License 1.0, https://www.openstreetmap.org/copyright";

bool is_osm(std::string_view first_bytes);
bool is_sumo_polygons(std::string_view first_bytes);

// Both throw InputError that names the file and the place in it.
Map read_osm(std::string_view content, const std::string& name, const ImportOptions& options);
Map read_sumo_polygons(std::string_view content, const std::string& name);

// The <location> of a .net.xml or .poly.xml.
struct SumoLocation {
  Georeference georeference;
  Extent boundary;  // of the network or the polygons, in its coordinates; empty where SUMO says that there is nothing
};
// Empty where it has none. Throws InputError where it is malformed.
std::optional<SumoLocation> sumo_location(std::string_view content, const std::string& name);

// "NAME:LINE" of a byte of the text.
std::string line_of(std::string_view content, std::ptrdiff_t offset, const std::string& name);

// The name of the root element of an XML text, of which the beginning is enough; empty where it is none.
std::string_view root_element(std::string_view text);

}  // namespace wavetracer::imports
