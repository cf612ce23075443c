// SPDX-License-Identifier: Apache-2.0
// Fields of vector maps by their names, and their meaning.
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
