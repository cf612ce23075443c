// SPDX-License-Identifier: Apache-2.0
// Maps as KML: corners against the inverse of the transverse Mercator projection of a sphere (Snyder 1987, equations
// 8-6 and 8-7), and what a layer's description says. read_kml.py parses the documents of the program.
#include "coverage/kml.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "contains.hpp"
#include "coverage/made_grid.hpp"
#include "coverage/write_map.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::coverage;
namespace fs = std::filesystem;

namespace {

constexpr double radius_m = 6371000;

// Longitude and latitude in degrees of a point of the sphere's transverse Mercator projection about (lon, lat).
glm::dvec2 on_sphere(double lon, double lat, double x_m, double y_m) {
  const double d = y_m / radius_m + lat * M_PI / 180, x = x_m / radius_m;
  return {lon + std::atan2(std::sinh(x), std::cos(d)) * 180 / M_PI, std::asin(std::sin(d) / std::cosh(x)) * 180 / M_PI};
}

// Three by two cells of 10 m from 0, 0 on, of which two have a path.
Map small_map(const std::string& grid = "g") {
  Map map{.grid = grid, .columns = 3, .rows = 2, .first_m = {5, 5}, .step_m = {10, 10}, .z_m = std::vector(6, 1.5)};
  map.transmitters = {"west & \"co\"", "<east>"};
  map.frame = 7;
  map.time_s = 0.5;
  map.cells.resize(6);
  map.cells[0].paths = map.cells[1].paths = 2;
  map.cells[0].best_server = 0;
  map.cells[1].best_server = 1;
  map.cells[0].path_gain_db = -70;
  map.cells[1].path_gain_db = -80;
  map.layers = {&layer_kind("path_gain_db"), &layer_kind("best_server"), &layer_kind("paths"), &layer_kind("tx_beam")};
  return map;
}

void check_corners(const std::array<glm::dvec2, 4>& corners, double lon, double lat, glm::dvec2 low_m) {
  for (size_t k = 0; k < 4; ++k) {
    const double x_m = low_m.x + (k == 1 || k == 2 ? 30 : 0), y_m = low_m.y + (k >= 2 ? 20 : 0);
    const glm::dvec2 expected = on_sphere(lon, lat, x_m, y_m);
    CHECK(std::abs(corners[k].x - expected.x) < 1e-11);
    CHECK(std::abs(corners[k].y - expected.y) < 1e-11);
  }
  double twice_area = 0;  // positive for corners that go round against the clock
  for (size_t k = 0; k < 4; ++k) {
    const glm::dvec2 &a = corners[k], &b = corners[(k + 1) % 4];
    twice_area += (a.x - corners[0].x) * (b.y - corners[0].y) - (b.x - corners[0].x) * (a.y - corners[0].y);
  }
  CHECK(twice_area > 0);
}

}  // namespace

TEST_CASE("the corners of a map are where the projection of a sphere has them") {
  const std::string sphere = "+proj=tmerc +R=6371000 +units=m ";
  const auto corners = [&](const std::string& origin, glm::dvec2 offset_m) {
    return corners_of(small_map(), {sphere + origin, offset_m, "", {}});
  };
  check_corners(corners("+lat_0=48 +lon_0=11", {0, 0}), 11, 48, {0, 0});
  check_corners(corners("+lat_0=48 +lon_0=11", {-100, 1000}), 11, 48, {100, -1000});
  check_corners(corners("+lat_0=-33 +lon_0=-70.5", {-200000, 0}), -70.5, -33, {200000, 0});  // far from the meridian
  check_corners(corners("+lat_0=-17 +lon_0=180", {15, 10}), 180, -17, {-15, -10});           // on both sides of 180
  check_corners(corners("+lat_0=-17 +lon_0=-180", {15, 10}), 180, -17, {-15, -10});
}

TEST_CASE("a map that is not on the earth is refused with the corner") {
  CHECK_THROWS_WITH_AS(corners_of(small_map(), {"+proj=eqc +R=6371000", {0, -1.1e7}, "", {}}),
                       doctest::Contains("--format kml: the corner x = 0 m, y = 0 m of the map is not on the earth in"),
                       InputError);
}

TEST_CASE("a document has an overlay for each layer, with its unit and the values of its colours") {
  const Map map = small_map("a<b");
  const std::vector<Overlay> overlays = {{map.layers[0], {-85, -60}, "path_gain_db.png"},
                                         {map.layers[1], {}, "best_server.png"},
                                         {map.layers[2], {0, 4}, "paths.png"},
                                         {map.layers[3], {}, "tx_beam.png"}};
  const std::string text = kml(map, {"+proj=tmerc +R=6371000 +lat_0=48 +lon_0=11", {0, 0}, "(c) A & B", {}}, overlays);
  for (
      const char* part :
      {"<name>a&lt;b</name><description>(c) A &amp; B</description>",
       "path gain of a&lt;b: -85 dB is dark, -60 dB is bright, frame 7 at 0.5 s<",
       "strongest transmitter of a&lt;b, frame 7 at 0.5 s: west &amp; &quot;co&quot; is #0072b2, &lt;east&gt; is #e69f00<",
       "number of paths of a&lt;b: 0 is dark, 4 is bright, ", "0 is #0072b2, 1 is #e69f00, ",
       "11 is #44aa99, and so on: colours repeat<", "<Icon><href>tx_beam.png</href></Icon>",
       "<visibility>1</visibility><description>path gain"}) {
    CAPTURE(text);
    CHECK(contains(text, part));
  }
  size_t shown = 0;
  for (size_t at = 0; (at = text.find("<visibility>1<", at)) != std::string::npos; ++at) ++shown;
  CHECK(shown == 1);
}

TEST_CASE("pictures lie beside the document, with a world file only for png; without a place there is none") {
  const Map map = small_map();
  test::TemporaryFolder folder;
  const Georeference place{"+proj=tmerc +R=6371000 +lat_0=48 +lon_0=11", {0, 0}, "", {}};
  std::vector<std::string> names;
  for (const fs::path& file : write_maps({{&map, 1}, true, {"kml"}, place}, folder.path() / "maps"))
    names.push_back(file.filename().string());
  CHECK(names == std::vector<std::string>{"best_server_7.png", "coverage.json", "coverage_7.kml", "path_gain_db_7.png",
                                          "paths_7.png", "tx_beam_7.png"});
  CHECK(write_maps({{&map, 1}, false, {"kml", "png"}, place}, folder.path() / "both").size() == 2 + 4 * 2);
  CHECK_THROWS_WITH_AS(write_maps({{&map, 1}, false, {"csv", "kml"}, {}}, folder.path() / "none"),
                       doctest::Contains("--format kml: where on the earth the scene is, is not known: put a"),
                       InputError);
  CHECK_FALSE(fs::exists(folder.path() / "none"));
  CHECK_THROWS_WITH_AS(georeference_for_kml({}, "town/scene.xml"), doctest::Contains("beside town/scene.xml, or"),
                       InputError);
}
