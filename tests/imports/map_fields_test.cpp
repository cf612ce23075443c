// SPDX-License-Identifier: Apache-2.0
// Fields of vector maps by their names, and their meaning.
#include <fmt/ranges.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "map_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("a field is the one that is called exactly so; one that differs by case stands in for it, several are told") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  const auto house = [&](const std::string& properties) {
    return folder.write("two.geojson", R"({"type": "FeatureCollection", "features": [)" +
                                           feature("Polygon", "[" + ring(rectangle(0, 0, 20, 20)) + "]", properties) +
                                           "]}");
  };
  const auto height = [&](const std::string& properties, const char* field, const char* levels = "") {
    return top_m(import_file(house(properties), fields(field, levels)).scene, "feature_");
  };
  const std::string both = R"("Height": 30, "height": 12, "HEIGHT": 7)";
  CHECK(height(both, "height") == 12);
  CHECK(height(both, "Height") == 30);
  CHECK(height(both, "HEIGHT") == 7);
  CHECK(height(both, "") == 12);
  CHECK(height(R"("Height": 30)", "height") == 30);
  CHECK(height(R"("Levels": 3, "levels": 5)", "", "levels") == 15);
  check_contains(refusal(house(R"("Height": 30, "HEIGHT": 7)"), fields("height", "")),
                 "several fields are called 'height', or differ from that by case alone; fields are Height, HEIGHT; "
                 "name one of them");
  const Imported first = import_file(house(R"("Height": 30, "HEIGHT": 7)"), {});
  CHECK(top_m(first.scene, "feature_") == 30);
  check_contains(first.summary.warnings.at(0), "the first of them is used");
  CHECK(height(R"("building:levels": 2, "roof:height": "5 m")", "") == 11);
}

TEST_CASE("woods of a map of GDAL are volumes of leaves, houses in them are houses") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  const auto polygon = [](const Points& points, const std::string& properties) {
    return feature("Polygon", "[" + ring(points) + "]", properties);
  };
  const fs::path file = folder.write(
      "woods.geojson",
      R"({"type": "FeatureCollection", "features": [)" +
          polygon(rectangle(0, 0, 20, 20), R"("building": "yes", "natural": null, "landuse": "forest", "height": 9)") +
          ", " +
          polygon(rectangle(40, 0, 90, 40), R"("building": null, "natural": "wood", "landuse": null, "height": 12)") +
          "]}");
  const auto [summary, scene] = import_file(file, {});
  CHECK(summary.buildings == 1);
  CHECK(summary.woods == 1);
  REQUIRE(scene.volumes.size() == 1);
  ImportOptions without;
  without.vegetation = false;
  const Imported bare = import_file(file, without);
  CHECK(bare.summary.left_out.at("forest (landuse=forest, natural=wood)") == 1);
  CHECK(bare.scene.volumes.empty());
}

namespace {

double volume_m3(const Volume& volume) {
  double six = 0;
  for (const auto& t : volume.triangles) six += glm::dot(t[0], glm::cross(t[1], t[2]));
  return six / 6;
}

std::string point(double x, double y, const std::string& properties) {
  const std::string closed = ring({{x, y}});  // the point twice
  return feature("Point", closed.substr(1, closed.find(']')), properties);
}

std::string collection(const std::vector<std::string>& features) {
  return fmt::format(R"({{"type": "FeatureCollection", "features": [{}]}})", fmt::join(features, ", "));
}

constexpr const char* house_tags = R"("building": "yes", "natural": null, "height": 9)";

}  // namespace

TEST_CASE("points and lines of trees are the volumes that the same trees of OpenStreetMap are") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  OsmText osm;
  osm.way(rectangle(-40, -40, -20, -20), {{"building", "yes"}, {"height", "9"}});
  osm.tree(0, 0, {{"natural", "tree"}, {"height", "12"}, {"diameter_crown", "6"}, {"leaf_type", "broadleaved"}});
  osm.tree(30, 0, {{"natural", "tree"}});
  osm.way({{10, -30}, {10, 0}}, {{"natural", "tree_row"}, {"height", "9 m"}, {"leaf_type", "needleleaved"}}, false);
  const Imported expected = import_text(osm.text(), folder);
  const std::string closed = ring({{10, -30}, {10, 0}});
  const std::string line = closed.substr(0, closed.rfind(", [")) + "]";
  const std::string houses = feature("Polygon", "[" + ring(rectangle(-40, -40, -20, -20)) + "]", house_tags);
  const std::vector<std::string> trees{
      point(0, 0, R"("natural": "tree", "height": "12", "diameter_crown": 6, "leaf_type": "broadleaved")"),
      point(30, 0, R"("natural": "tree")"), point(60, 0, R"("natural": "peak", "height": "7")")};
  const std::string row =
      feature("LineString", line, R"("natural": "tree_row", "height": "9 m", "leaf_type": "needleleaved")");
  const fs::path all = folder.write("trees.geojson", collection({houses, trees[0], trees[1], trees[2], row}));
  const fs::path packed = folder.path() / "trees.gpkg";
  REQUIRE(run(fmt::format("{} -f GPKG '{}' '{}'", WAVETRACER_OGR2OGR, packed.string(), all.string())));
  for (const fs::path& file : {all, packed}) {
    CAPTURE(file.string());
    const auto [summary, scene] = import_file(file, {});
    CHECK(summary.buildings == 1);
    CHECK(summary.trees == 2);
    CHECK(summary.trees_of_rows == 4);
    CHECK(summary.left_out.at("point or line that is no tree (natural=tree, natural=tree_row)") == 1);
    CHECK(summary.guessed == expected.summary.guessed);
    CHECK(summary.guessed.at("tree without a height: 10 m used") == 1);
    REQUIRE(scene.volumes.size() == expected.scene.volumes.size());
    for (size_t i = 0; i < scene.volumes.size(); ++i) {
      CHECK(volume_m3(scene.volumes[i]) == doctest::Approx(volume_m3(expected.scene.volumes[i])).epsilon(0.01));
      CHECK(scene.materials[scene.volumes[i].material].name ==
            expected.scene.materials[expected.scene.volumes[i].material].name);
    }
    check_contains(describe(summary), "single trees 2, trees in rows 4, woods 0");
    check_contains(describe(summary),
                   "trees      height from 'height', diameter of the crown from 'diameter_crown', kind of leaves from "
                   "'leaf_type'\n");
    ImportOptions without;
    without.vegetation = false;
    const Imported bare = import_file(file, without);
    CHECK(bare.scene.volumes.empty());
    CHECK(bare.summary.left_out.at("tree (natural=tree)") == 2);
    CHECK(bare.summary.left_out.at("row of trees (natural=tree_row)") == 1);
  }
}

TEST_CASE("a table of trees needs no field natural, and may be in metres, or a Shapefile") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  const fs::path json =
      folder.write("register.geojson", collection({point(0, 0, R"("Height": 12, "diameter_crown": 6)"),
                                                   point(9, 0, R"("Height": 5, "diameter_crown": null)"),
                                                   point(20, 0, R"("Height": 9, "diameter_crown": 3)")}));
  const fs::path shapes = folder.path() / "register.shp";
  REQUIRE(run(fmt::format("{} -f 'ESRI Shapefile' '{}' '{}'", WAVETRACER_OGR2OGR, shapes.string(), json.string())));
  const fs::path rows = folder.write("rows.csv",
                                     "WKT,Height,diameter_crown\n\"POINT (1000 2000)\",12,6\n\"POINT (1009 2000)\",5,\n"
                                     "\"POINT (1020 2000)\",9,3\n");
  const fs::path metres = folder.path() / "rows.gpkg";
  REQUIRE(run(fmt::format("{} '{}' '{}'", WAVETRACER_OGR2OGR, metres.string(), rows.string())));
  for (const fs::path& file : {json, shapes, metres}) {
    CAPTURE(file.string());
    const auto [summary, scene] = import_file(file, {});
    CHECK(summary.trees == 2);
    CHECK(summary.left_out.at("point or line that is no tree (natural=tree, natural=tree_row)") == 1);
    REQUIRE(scene.volumes.size() == 2);
    CHECK(volume_m3(scene.volumes[0]) == doctest::Approx(8 * 9 * 3.14159265).epsilon(0.01));
    CHECK(volume_m3(scene.volumes[1]) == doctest::Approx(6 * 2.25 * 3.14159265).epsilon(0.01));
    check_contains(summary.tree_columns, "height from 'height', diameter of the crown from 'diameter_c");
  }
  // Fields of heights that are named count for trees, and --levels leaves them the field that they usually have.
  const auto tallest = [&](const ImportOptions& options) {
    double top = 0;
    const Scene scene = import_file(json, options).scene;
    for (const Volume& volume : scene.volumes)
      for (const auto& t : volume.triangles)
        for (const glm::dvec3& corner : t) top = std::max(top, corner.z + scene.origin_m.z);
    return top;
  };
  CHECK(tallest(fields("diameter_crown", "")) == 6);
  CHECK(tallest(fields("", "Height")) == 12);
}
