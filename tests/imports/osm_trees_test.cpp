// SPDX-License-Identifier: Apache-2.0
// Trees, rows of trees and woods of OpenStreetMap, compared with volumes and heights that are known.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "check_contains.hpp"
#include "imported.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("trees, rows and woods are volumes of leaves unless they are refused, and buildings stay what they are") {
  OsmText map;
  map.way(rectangle(-40, -40, -20, -20), {{"building", "yes"}, {"height", "8"}});
  map.tree(0, 0, {{"natural", "tree"}, {"height", "12"}, {"diameter_crown", "6"}, {"leaf_type", "broadleaved"}});
  map.way({{10, -30}, {10, 0}}, {{"natural", "tree_row"}, {"height", "9 m"}, {"leaf_type", "needleleaved"}}, false);
  const int outer = map.way(rectangle(20, 10, 60, 50), {}), inner = map.way(rectangle(30, 20, 40, 30), {});
  map.relation({{outer, "outer"}, {inner, "inner"}}, {{"natural", "wood"}});
  map.way(rectangle(45, 35, 50, 40), {{"building", "yes"}, {"building:part", "yes"}, {"height", "5"}});
  const TemporaryFolder folder;
  ImportOptions options;
  options.vegetation = false;
  const Imported without = import_text(map.text(), folder, options);
  CHECK(without.summary.trees + without.summary.trees_of_rows + without.summary.woods == 0);
  CHECK(without.scene.volumes.empty());
  CHECK(without.summary.left_out.size() == 3);
  const auto [summary, scene] = import_text(map.text(), folder);
  CHECK(summary.left_out.empty());
  CHECK(summary.trees == 1);
  CHECK(summary.trees_of_rows == 4);
  CHECK(summary.woods == 1);
  check_contains(describe(summary), "vegetation single trees 1, trees in rows 4, woods 1;");
  CHECK(summary.guessed.at("wood without a height: 20 m used") == 1);
  CHECK(summary.guessed.at("tree without diameter_crown: half of its height used, a third with needles") == 4);
  REQUIRE(scene.volumes.size() == 6);
  CHECK(scene.triangles.size() == without.scene.triangles.size());
  // For each material the number of volumes, and their cubic metres.
  std::map<std::string, std::pair<size_t, double>> found;
  double top = 0;
  for (const Volume& volume : scene.volumes) {
    double six = 0;
    for (const auto& t : volume.triangles) {
      six += glm::dot(t[0], glm::cross(t[1], t[2]));
      for (const glm::dvec3& corner : t) top = std::max(top, corner.z + scene.origin_m.z);
    }
    auto& [count, cubic_m] = found[scene.materials[volume.material].name];
    ++count;
    cubic_m += six / 6;
  }
  CHECK(top == 20);
  CHECK(found["deciduous_vegetation"].first == 1);
  CHECK(std::abs(found["deciduous_vegetation"].second - 8 * 9 * 3.14159265) < 3);  // a round crown of 4 to 12 m
  CHECK(found["vegetation"].first == 5);
  CHECK(std::abs(found["vegetation"].second - (21 * 1500 + 4 * 6 * 2.25 * 3.14159265)) < 30);
}

TEST_CASE("a row of trees across the country is left out, and says so") {
  OsmText map;
  map.way(rectangle(-40, -40, -20, -20), {{"building", "yes"}});
  map.way({{0, 0}, {9000, 0}}, {{"natural", "tree_row"}}, false);
  map.way({{0, 0}, {90, 0}}, {{"natural", "tree_row"}}, false);
  const TemporaryFolder folder;
  const Imported town = import_text(map.text(), folder);
  CHECK(town.summary.trees_of_rows == 12);
  CHECK(town.summary.left_out.at("row of more than 1000 trees, or beyond 200,000 trees in rows") == 1);
}

TEST_CASE("greenery that is not built and leaves that are not known are counted") {
  OsmText map;
  map.way(rectangle(-40, -40, -20, -20), {{"building", "yes"}, {"height", "8"}});
  map.way({{0, 0}, {30, 0}}, {{"barrier", "hedge"}}, false);
  map.way(rectangle(0, 10, 20, 30), {{"natural", "scrub"}});
  map.way(rectangle(0, 40, 20, 60), {{"landuse", "orchard"}});
  map.tree(50, 0, {{"natural", "tree"}, {"height", "9"}, {"diameter_crown", "4"}, {"leaf_type", "palm"}});
  const TemporaryFolder folder;
  const ImportSummary summary = import_text(map.text(), folder).summary;
  CHECK(summary.trees == 1);
  CHECK(summary.left_out == std::map<std::string, uint64_t>{{"hedge (barrier=hedge)", 1},
                                                            {"orchard (landuse=orchard)", 1},
                                                            {"scrub (natural=scrub)", 1}});
  CHECK(summary.guessed == std::map<std::string, uint64_t>{{"leaf_type that is not known: mixed vegetation used", 1}});
}
