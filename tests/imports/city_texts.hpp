// SPDX-License-Identifier: Apache-2.0
// City models as texts, put together from pieces: a house with a gable roof in CityJSON, a cube in CityGML.
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "imports/imports.hpp"

namespace wavetracer::test {

// A house of 12 x 8 m, eaves at 6 m, ridge at 10 m, on 100 m above the sea; vertices in cm.
inline constexpr const char* gable_vertices =
    "[[0,0,0],[1200,0,0],[1200,800,0],[0,800,0],[0,0,600],[1200,0,600],[1200,800,600],[0,800,600],[0,400,1000],"
    "[1200,400,1000]]";
inline constexpr const char* gable_solid =
    "[[[[0,3,2,1]],[[0,1,5,4]],[[2,3,7,6]],[[3,0,4,8,7]],[[1,2,6,9,5]],[[4,5,9,8]],[[6,7,8,9]]]]";
inline constexpr const char* gable_semantics =
    R"("semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"WallSurface"},{"type":"RoofSurface"}],)"
    R"("values":[[0,1,1,1,1,2,2]]})";
constexpr double gable_volume = 12 * 8 * (6 + 2), gable_floor = 12 * 8;
inline const double gable_roof = 2 * 12 * std::hypot(4.0, 4.0);

inline std::string city_json(const std::string& objects, const std::string& vertices = gable_vertices,
                             const std::string& rest = "") {
  return fmt::format(
      R"({{"type":"CityJSON","version":"2.0","transform":{{"scale":[0.01,0.01,0.01],"translate":[0,0,100]}},{})"
      R"("CityObjects":{{{}}},"vertices":{}}})",
      rest, objects, vertices);
}

inline std::string building(const std::string& id, const std::string& geometries, const std::string& type = "Building",
                            const std::string& rest = "") {
  return fmt::format(R"("{}":{{"type":"{}",{}"geometry":[{}]}})", id, type, rest, geometries);
}

inline std::string solid(const std::string& lod, const std::string& boundaries, const std::string& rest = "") {
  return fmt::format(R"({{"type":"Solid","lod":"{}","boundaries":{}{}{}}})", lod, boundaries, rest.empty() ? "" : ",",
                     rest);
}

inline std::string gable_house(const std::string& id = "house") {
  return building(id, solid("2.2", gable_solid, gable_semantics));
}

inline ImportOptions without_ground() {
  ImportOptions options;
  options.ground = false;
  return options;
}

inline std::string gml(const std::string& members, const std::string& root = "") {
  return "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/2.0\" "
         "xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\" xmlns:gml=\"http://www.opengis.net/gml\" "
         "xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n" +
         root + members + "</core:CityModel>\n";
}

inline std::string gml_building(const std::string& content) {
  return "<core:cityObjectMember><bldg:Building gml:id=\"b\">" + content + "</bldg:Building></core:cityObjectMember>\n";
}

inline std::string pos_list(const std::string& points) {
  return "<gml:LinearRing><gml:posList>" + points + "</gml:posList></gml:LinearRing>";
}

inline std::string member(const std::string& ring, const std::string& holes = "") {
  return "<gml:surfaceMember><gml:Polygon><gml:exterior>" + ring + "</gml:exterior>" + holes +
         "</gml:Polygon></gml:surfaceMember>";
}

// The faces of a cube of 10 m.
inline std::vector<std::string> cube_rings() {
  return {"0 0 0 0 10 0 10 10 0 10 0 0 0 0 0",       "0 0 10 10 0 10 10 10 10 0 10 10 0 0 10",
          "0 0 0 10 0 0 10 0 10 0 0 10 0 0 0",       "10 0 0 10 10 0 10 10 10 10 0 10 10 0 0",
          "10 10 0 0 10 0 0 10 10 10 10 10 10 10 0", "0 10 0 0 0 0 0 0 10 0 10 10 0 10 0"};
}

inline std::string cube_surface(const std::string& kind = "CompositeSurface") {
  std::string out = "<gml:" + kind + ">";
  for (const std::string& ring : cube_rings()) out += member(pos_list(ring));
  return out + "</gml:" + kind + ">";
}

inline std::string solid_gml(const std::string& surface) {
  return "<gml:Solid><gml:exterior>" + surface + "</gml:exterior></gml:Solid>";
}

}  // namespace wavetracer::test
