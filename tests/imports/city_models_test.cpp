// SPDX-License-Identifier: Apache-2.0
// Properties that city models of both formats share: triangles of faces, coordinate systems, and messages about broken
// files.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "city_texts.hpp"
#include "imported.hpp"
#include "imports/model_faces.hpp"
#include "imports/source_system.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("faces in any plane, with holes that touch, and such that cannot be built") {
  using imports::GridFace;
  const auto area = [](const GridFace& face) {
    const imports::FaceTriangles found = imports::triangulate_face(face);
    std::vector<glm::dvec3> corners;
    for (const auto& ring : face.rings)
      for (const auto& p : ring) corners.push_back(imports::metres(p));
    glm::dvec3 sum(0);
    for (const auto& t : found.triangles)
      sum += glm::cross(corners[t[1]] - corners[t[0]], corners[t[2]] - corners[t[0]]) / 2.0;
    return glm::dot(sum, glm::normalize(imports::area_vector(face)));
  };
  // A square of 8 m with a hole of 2 m in planes all round, of either winding.
  for (int turn = 0; turn < 24; ++turn) {
    CAPTURE(turn);
    const double angle = turn * 0.2618, tilt = turn * 0.37;
    const glm::dvec3 u(std::cos(angle), std::sin(angle), 0),
        v(-std::sin(angle) * std::cos(tilt), std::cos(angle) * std::cos(tilt), std::sin(tilt));
    const auto ring = [&](double a, double b, bool back) {
      imports::SpaceRing out{u * a + v * a, u * b + v * a, u * b + v * b, u * a + v * b};
      if (back) std::ranges::reverse(out);
      return out;
    };
    const GridFace face =
        imports::on_grid({imports::Role::wall, {ring(0, 8, turn % 2 == 0), ring(3, 5, turn % 3 == 0)}});
    CHECK(area(face) == doctest::Approx(60).epsilon(1e-3));
  }
  const auto flat = [](const std::vector<std::vector<std::pair<double, double>>>& rings) {
    imports::ModelFace face;
    for (const auto& ring : rings) {
      face.rings.emplace_back();
      for (const auto& [x, y] : ring) face.rings.back().emplace_back(x, y, 7);
    }
    return imports::on_grid(face);
  };
  // A hole that touches the outline in a corner; a ring that passes a point twice.
  const GridFace touching = flat({{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{0, 0}, {4, 2}, {2, 4}}});
  CHECK(imports::triangulate_face(touching).crossing);
  CHECK(area(touching) == doctest::Approx(94).epsilon(1e-3));
  const GridFace eight = flat({{{0, 0}, {4, 0}, {4, 4}, {8, 4}, {8, 8}, {4, 8}, {4, 4}, {0, 4}}});
  CHECK(area(eight) == doctest::Approx(32).epsilon(1e-3));
  // Spikes, and ways there and back, vanish.
  CHECK(flat({{{0, 0}, {4, 0}, {9, 0}, {4, 0}, {4, 4}, {4, 4}, {0, 4}, {0, 0}}}).rings[0].size() == 4);
  CHECK(flat({{{5, 5}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}}}).rings[0].size() == 4);
  CHECK(flat({{{0, 0}, {5, 5}, {0, 0}}}).rings[0].size() < 3);
  // A bow tie has no triangles of one side that are as large as it is.
  CHECK(imports::triangulate_face(flat({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}})).fault == "no area");
  CHECK(imports::triangulate_face(flat({{{0, 0}, {1e5, 0}, {1e5, 1e5}}})).fault ==
        "too far from the middle of the map");
}

TEST_CASE("coordinate systems: codes in all spellings, swapped axes, units, and places that cannot be") {
  CHECK(imports::system_code("https://www.opengis.net/def/crs/EPSG/0/7415") == "EPSG:7415");
  CHECK(imports::system_code("urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783") == "EPSG:3068");
  CHECK(imports::system_code("urn:ogc:def:crs:EPSG::25832") == "EPSG:25832");
  CHECK(imports::system_code("urn:ogc:def,crs::EPSG:31467") == "EPSG:31467");
  CHECK(imports::system_code("http://www.opengis.net/gml/srs/epsg.xml#4326") == "EPSG:4326");
  CHECK(imports::system_code("EPSG:25832+7837") == "EPSG:25832");
  CHECK(imports::system_code("urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH") == "EPSG:25832");
  CHECK(imports::system_code("urn:ogc:def:crs:OGC:1.3:CRS84") == "OGC:CRS84");
  CHECK(imports::system_code("EPSG").empty());
  CHECK(imports::system_code("my own system").empty());

  // The longitude and latitude of a place in Munich, written in several ways. Roofs look up, or would look down if the
  // axes were not swapped.
  struct Row {
    const char* system;
    double x, y, up;
  };
  for (const Row& row : {Row{"urn:ogc:def:crs:EPSG::25832", 691000, 5335000, 0},
                         {"urn:ogc:def:crs:EPSG::25832", 5335000, 691000, -1},
                         {"EPSG:4326", 11.567501, 48.139558, 1},
                         {"EPSG:4326", 48.139558, 11.567501, -1},
                         {"urn:ogc:def:crs:EPSG::4326", 48.139558, 11.567501, -1},
                         {"urn:ogc:def:crs:EPSG::4326", 11.567501, 48.139558, 1},
                         {"urn:ogc:def:crs:EPSG::4326", 48.139558, 11.567501, 0},
                         {"EPSG:4326", 11.567501, 48.139558, 0},
                         {"urn:ogc:def:crs:EPSG::31468", 4467919.51, 5333593.57, 1},
                         {"https://www.opengis.net/def/crs/EPSG/0/4979", 11.567501, 48.139558, 1}}) {
    CAPTURE(row.system);
    CAPTURE(row.x);
    imports::SourceSystem system(row.system, "town");
    system.choose_order({row.x, row.y}, row.up);
    const glm::dvec2 place = system.geographic({row.x, row.y});
    CHECK(std::abs(place.x - 11.567501) < 5e-5);
    CHECK(std::abs(place.y - 48.139558) < 5e-5);
  }
  imports::SourceSystem feet("EPSG:6539", "town");  // New York, US survey feet
  CHECK(feet.metres_per_height() == doctest::Approx(0.3048006096));
  CHECK(imports::SourceSystem("EPSG:4979", "town").above_ellipsoid());
  imports::SourceSystem utm("EPSG:25832", "town");
  CHECK_THROWS_WITH_AS(utm.choose_order({12, 7}, 0), doctest::Contains("is not in the area"), InputError);
  CHECK_THROWS_WITH_AS(imports::SourceSystem("EPSG:99999", "town"), doctest::Contains("not known to PROJ"), InputError);
  CHECK_THROWS_WITH_AS(imports::SourceSystem("EPSG:7837", "town"), doctest::Contains("none of places on a map"),
                       InputError);
  CHECK_THROWS_WITH_AS(imports::SourceSystem("local", "town"), doctest::Contains("not one of EPSG"), InputError);
}

TEST_CASE("broken city models are refused with the place and the reason") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const char* why) {
    CAPTURE(why);
    CHECK_THROWS_WITH_AS(import_text(text, folder), doctest::Contains(why), InputError);
  };
  const std::string whole = city_json(gable_house());
  refused(whole.substr(0, whole.size() - 40), "map:1: not well-formed JSON");
  refused(whole + "\n{\"type\":\"CityJSONFeature\"}", "cjseq collect");
  refused(R"({"type":"CityJSON","version":"0.9","CityObjects":{},"vertices":[]})", "upgrade");
  refused(R"({"type":"CityJSONFeature","CityObjects":{},"vertices":[]})", "is not \"CityJSON\"");
  refused(R"({"type":"CityJSON","version":"2.0","CityObjects":[],"vertices":[]})", "CityObjects");
  refused(city_json(gable_house(), "[[0,0,1e999]]"), "too large");
  refused(city_json(gable_house(), "[[0,0]]"), "vertices/0: must be three numbers");
  refused(city_json(gable_house(), "[[0,0,0]]"), "names vertex 3, but they are 0 to 0");
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  refused(city_json(building("b", solid("2", "[[[[" + deep + "]]]]"))), "names vertex of the type array, but they are");
  refused(city_json(building("b", solid("x", gable_solid))), "CityObjects/b/geometry/0: lod");
  refused(city_json(building("b", solid("2", gable_solid, R"("semantics":{"values":[[7]]})"))), "names surface 7");
  refused(city_json(building("b", solid("2", gable_solid), "BuildingPart", R"("parents":["c"],)")), "its parent 'c'");
  refused(city_json(building("b", solid("2", gable_solid), "BuildingPart", R"("parents":["b"],)")), "without end");
  refused(city_json("\"tree\":{\"type\":\"PlantCover\"}"), "contains no building");
  refused(city_json(gable_house(), gable_vertices,
                    R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25832"},)"),
          "is not in the area");
  refused(gml("<a>"), "map:2: not well-formed XML");
  refused("<CityModel xmlns=\"http://www.opengis.net/citygml/3.0\"/>", "CityGML 3.0");
  const auto one = [&](const std::string& ring) {
    return gml(gml_building("<bldg:lod2MultiSurface><gml:MultiSurface>" + member(ring) +
                            "</gml:MultiSurface></bldg:lod2MultiSurface>"));
  };
  refused(one(pos_list("0 0 0 1 0")), "not a multiple of three");
  refused(one(pos_list("0 0 x")), "map:2: <gml:posList>: 'x' is not a coordinate");
  refused(one("<gml:LinearRing><gml:posList srsDimension=\"2\">0 0 1 1</gml:posList></gml:LinearRing>"),
          "have no heights");
  refused(one(pos_list("0 0 0 1 0 0")), "contains no building");
  refused(gml(gml_building("<bldg:lod2Solid xlink:href=\"#x\"/>")), "leads nowhere");
  refused(gml(gml_building("<a srsName=\"EPSG:25832\"/><a srsName=\"EPSG:25833\"/>")), "one coordinate system");
  ImportOptions options;
  options.layer = "buildings";
  CHECK_THROWS_WITH_AS(import_text(whole, folder, options), doctest::Contains("--layer"), ConfigError);
  ImportOptions lod;
  lod.lod = "2";
  CHECK_THROWS_WITH_AS(import_text("<osm/>", folder, lod), doctest::Contains("--lod is for CityJSON"), ConfigError);
}
