// SPDX-License-Identifier: Apache-2.0
// OpenStreetMap texts compared with areas, volumes and heights that are known. Nodes are rounded to 11 mm.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <sstream>

#include "imported.hpp"
#include "scene/georeference.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Returns the area error of a shape with this border: every corner may be off by half of 11 mm.
double area_error(double perimeter_m) { return perimeter_m * 0.0085; }

}  // namespace

TEST_CASE("a house is where it is, as high as it says, of what it says, under its name") {
  OsmText map;
  const int house = map.way(rectangle(10, 20, 30, 35), {{"building", "yes"},
                                                        {"height", "12,5 m"},
                                                        {"building:material", "brick"},
                                                        {"roof:material", "copper"},
                                                        {"name", "Bäckerei Øst Nr. 5 &amp; Söhne"}});
  map.way(rectangle(-30, -35, -10, -20), {{"building", "yes"}, {"building:levels", "4"}});
  const TemporaryFolder folder;
  const auto [summary, scene] = import_text(map.text(), folder);
  const std::string id = "way_" + std::to_string(house);
  CHECK(summary.buildings == 2);
  CHECK(summary.left_out.empty());
  CHECK(std::abs(roof_area_m2(scene, id + " Bäckerei Øst Nr_ 5 & Söhne roof") - 300) < area_error(70));
  CHECK(std::abs(volume_m3(scene, id) - 300 * 13.5) < 13.5 * area_error(70));  // 1 m of it below the ground
  CHECK(top_m(scene, id) == 12.5);
  CHECK(bottom_m(scene, id) == -1);
  CHECK(material(scene, id + " Bäckerei Øst Nr_ 5 & Söhne roof") == "metal");
  CHECK(top_m(scene, "way") == 12.5);
  // The middle of both is the origin; the second is the first one turned by half.
  CHECK(std::abs(summary.lower_m.x + 30) < 0.02);
  CHECK(std::abs(summary.upper_m.y - 35) < 0.02);
  CHECK(scene.report.nonmanifold_edges == 0);
  CHECK(scene.report.free_edges == 4);  // those of the ground
  CHECK(summary.attribution.find("OpenStreetMap") != std::string::npos);
  std::ostringstream xml;
  xml << std::ifstream(summary.scene).rdbuf();
  CHECK(xml.str().find("OpenStreetMap contributors, Open Database License") != std::string::npos);
  CHECK(describe(summary).find("OpenStreetMap contributors") != std::string::npos);
}

TEST_CASE("georeference.json leads back to the degrees of the map") {
  OsmText map;
  map.way(rectangle(-40, -30, 40, 30), {{"building", "yes"}});
  const TemporaryFolder folder;
  const auto [summary, scene] = import_text(map.text(), folder);
  const auto reference = find_georeference(summary.scene);
  REQUIRE(reference);
  const glm::dvec2 middle = Projection(*reference).geographic((summary.lower_m + summary.upper_m) / 2.0);
  CHECK(std::abs(middle.x - 11.575) < 2e-7);
  CHECK(std::abs(middle.y - 48.137) < 2e-7);
}

TEST_CASE("courtyards of multipolygons, and two outlines in one") {
  OsmText map;
  const int outer = map.way(rectangle(0, 0, 50, 40), {});
  const int inner = map.way(rectangle(10, 10, 40, 30), {});
  const int second = map.way(rectangle(100, 0, 110, 10), {});
  const int relation = map.relation({{outer, "outer"}, {inner, "inner"}, {second, "outer"}},
                                    {{"building", "yes"}, {"building:levels", "5"}});
  const TemporaryFolder folder;
  const auto [summary, scene] = import_text(map.text(), folder);
  const std::string id = "relation_" + std::to_string(relation);
  CHECK(summary.buildings == 2);
  CHECK(summary.courtyards == 1);
  CHECK(std::abs(volume_m3(scene, id) - (2000 - 600 + 100) * 16) < 16 * area_error(180 + 100 + 40));
  CHECK(scene.report.free_edges == 4);
}

TEST_CASE("a relation and its outer way both tagged: the courtyard stays open") {
  OsmText map;
  const int outer = map.way(rectangle(0, 0, 50, 40), {{"building", "yes"}});
  const int inner = map.way(rectangle(10, 10, 40, 30), {});
  map.relation({{outer, "outer"}, {inner, "inner"}}, {{"building", "yes"}});
  const TemporaryFolder folder;
  const auto [summary, scene] = import_text(map.text(), folder);
  CHECK(summary.buildings == 1);
  CHECK(summary.courtyards == 1);
  CHECK(summary.left_out.at("outline that occurs twice") == 1);
  CHECK(std::abs(volume_m3(scene, "relation") - 1400 * 11) < 11 * area_error(280));
}

TEST_CASE("Simple 3D Buildings: parts instead of their outline, an outline without parts beside it") {
  OsmText map;
  map.way(rectangle(0, 0, 40, 20), {{"building", "yes"}, {"height", "30"}});
  map.way(rectangle(0, 0, 20, 20), {{"building:part", "yes"}, {"height", "10"}});
  const int tower =
      map.way(rectangle(20, 0, 40, 20), {{"building:part", "yes"}, {"height", "30"}, {"min_height", "5"}});
  const int other = map.way(rectangle(60, 0, 70, 20), {{"building", "yes"}, {"height", "8"}, {"building:part", "no"}});
  const TemporaryFolder folder;
  const auto [summary, scene] = import_text(map.text(), folder);
  CHECK(summary.buildings == 1);
  CHECK(summary.parts == 2);
  CHECK(summary.left_out.at("outline whose parts are built instead") == 1);
  const std::string id = "way_" + std::to_string(tower);
  CHECK(bottom_m(scene, id) == 5);
  CHECK(std::abs(volume_m3(scene, id) - 400 * 25) < 25 * area_error(80));
  CHECK(std::abs(volume_m3(scene, "way_" + std::to_string(other)) - 200 * 9) < 9 * area_error(60));
}

TEST_CASE("clipped and broken outlines are left out, and say why") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}});
  map.way({{20, 0}, {30, 0}, {30, 10}}, {{"building", "yes"}}, false);     // does not close
  map.way({{40, 0}, {50, 10}, {50, 0}, {40, 10}}, {{"building", "yes"}});  // a bow tie
  const int outer = map.way(rectangle(60, 0, 80, 10), {});
  map.relation({{outer, "outer"}, {999999, "inner"}}, {{"building", "yes"}});  // a member is missing
  std::string text = map.text();
  text.insert(text.rfind("</osm>"),
              "<way id=\"5000\"><nd ref=\"1\"/><nd ref=\"2\"/><nd ref=\"777777\"/><nd ref=\"1\"/>"
              "<tag k=\"building\" v=\"yes\"/></way>");  // a node is missing
  const TemporaryFolder folder;
  const auto [summary, scene] = import_text(text, folder);
  CHECK(summary.buildings == 1);
  uint64_t left_out = 0;
  for (const auto& [reason, count] : summary.left_out) left_out += count;
  CHECK(left_out == 4);
  CHECK(summary.left_out.size() == 4);
  CHECK(summary.left_out.at("outline with a missing node, as if clipped at the border of an extract") == 1);
  CHECK(describe(summary).find("outline that crosses itself") != std::string::npos);
}

TEST_CASE("the order of objects does not matter: Overpass writes nodes last") {
  OsmText map;
  const int outer = map.way(rectangle(0, 0, 50, 40), {});
  const int inner = map.way(rectangle(10, 10, 40, 30), {});
  map.relation({{outer, "outer"}, {inner, "inner"}}, {{"building", "yes"}});
  const TemporaryFolder folder;
  const Imported first = import_text(map.text(), folder), last = import_text(map.text(true), folder);
  CHECK(first.scene.vertices == last.scene.vertices);
  CHECK(first.scene.triangles == last.scene.triangles);
}

TEST_CASE("the ground reaches below the network of --net and the traffic, with a margin") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}});
  const TemporaryFolder folder;
  const auto net = [&](const std::string& boundary) {
    return folder.write("town.net.xml", "<net><location netOffset=\"0,0\" convBoundary=\"" + boundary +
                                            "\" projParameter=\"+proj=tmerc +lat_0=48.137 +lon_0=11.575 +ellps=WGS84 "
                                            "+units=m +no_defs\"/></net>");
  };
  const auto ground_of = [&](const ImportOptions& options) {
    const Scene scene = import_text(map.text(), folder, options).scene;
    glm::dvec3 lower(1e300), upper(-1e300);
    for (size_t t = 0; t < scene.triangles.size(); ++t)
      for (const uint32_t v : scene.triangles[t])
        if (scene.objects[scene.triangle_object[t]].starts_with("ground")) {
          lower = glm::min(lower, scene.vertices[v] + scene.origin_m);
          upper = glm::max(upper, scene.vertices[v] + scene.origin_m);
        }
    return std::array{lower.x, lower.y, upper.x, upper.y};
  };
  ImportOptions options;
  options.net = net("-900.5,-20,300,1200");
  CHECK(ground_of(options) == std::array{-950.5, -70.0, 350.0, 1250.0});
  options.margin_m = 10;
  options.traffic.add({-2000, 0});
  options.traffic.add({0, 1500});
  CHECK(ground_of(options) == std::array{-2010.0, -30.0, 310.0, 1510.0});
  // The network has no edges, as SUMO writes it; none; or an impossible extent.
  options = {};
  for (const char* nothing : {"10000000000.00,10000000000.00,-10000000000.00,-10000000000.00", ""}) {
    options.net = net(nothing);
    CHECK(std::abs(ground_of(options)[2] - 60) < 0.02);
  }
  for (const char* bad : {"1,2,3", "1,2,3,4,5", "a,b,c,d", "0,0,nan,1"}) {
    options.net = net(bad);
    CHECK_THROWS_WITH_AS(ground_of(options), doctest::Contains("convBoundary"), InputError);
  }
  options.net = net("0,0,600000,10");
  CHECK_THROWS_WITH_AS(ground_of(options), doctest::Contains("the network reaches (600, 0) km"), InputError);
  options.ground = false;
  CHECK_NOTHROW(import_text(map.text(), folder, options));
}

TEST_CASE("trees and forests that are not wanted are counted") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}});
  map.way(rectangle(20, 0, 90, 90), {{"landuse", "forest"}});
  map.way(rectangle(20, 100, 90, 190), {{"natural", "wood"}});
  map.way({{0, 40}, {10, 50}, {20, 60}}, {{"natural", "tree_row"}}, false);
  map.way(rectangle(100, 0, 190, 90), {{"natural", "water"}});
  std::string text = map.text();
  for (int i = 0; i < 7; ++i)
    text.insert(text.rfind("</osm>"), "<node id=\"" + std::to_string(90000 + i) +
                                          "\" lat=\"48.137\" lon=\"11.575\"><tag k=\"natural\" v=\"tree\"/></node>");
  const TemporaryFolder folder;
  ImportOptions options;
  options.vegetation = false;
  const auto [summary, scene] = import_text(text, folder, options);
  CHECK(summary.left_out == std::map<std::string, uint64_t>{{"tree (natural=tree)", 7},
                                                            {"row of trees (natural=tree_row)", 1},
                                                            {"forest (landuse=forest, natural=wood)", 2}});
  CHECK(describe(summary).find("      7  tree (natural=tree)\n") != std::string::npos);
}

TEST_CASE("options: no ground, other materials; errors name what is wrong") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}});
  const TemporaryFolder folder;
  ImportOptions options;
  options.ground = false;
  options.wall_material = options.roof_material = "brick";
  const auto [summary, scene] = import_text(map.text(), folder, options);
  CHECK_FALSE(has_object(scene, "ground"));
  CHECK(material(scene, "way") == "brick");
  CHECK(summary.triangles == 12);
  options.wall_material = "gingerbread";
  CHECK_THROWS_AS(import_text(map.text(), folder, options), ConfigError);
  CHECK_THROWS_WITH_AS(import_text(OsmText().text(), folder), doctest::Contains("no building"), InputError);
  CHECK_THROWS_WITH_AS(import_text("<osm><way", folder), doctest::Contains("OSM XML"), InputError);
  CHECK_THROWS_WITH_AS(import_text("<net/>", folder), doctest::Contains(".osm.pbf"), InputError);
}

TEST_CASE("coordinates in scientific notation are places, or refused where they are beyond all numbers") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "yes"}});
  const TemporaryFolder folder;
  const auto with_node = [&](const std::string& attributes) {
    std::string text = map.text();
    text.insert(text.rfind("</osm>"), "\n<node id=\"90000\" version=\"1\" " + attributes + "/>\n");
    return import_text(text, folder);
  };
  for (const char* good : {"lat=\"1.2e1\" lon=\"5e-99\"", "lat=\"1\" lon=\"2\" note=\"flat='1e60'\""})
    CHECK_NOTHROW(with_node(good));
  for (const char* bad : {"lat=\"1e60\" lon=\"1\"", "lat=\"1\"\n lon = '-48e17'", "lat=\"1e9999\" lon=\"1\""}) {
    CAPTURE(bad);
    CHECK_THROWS_WITH_AS(with_node(bad), doctest::Contains("is no place on the globe"), InputError);
  }
}
