// SPDX-License-Identifier: Apache-2.0
// SUMO's polygons against exact areas and volumes: their decimals are on the grid of the import.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "imported.hpp"
#include "scene/georeference.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::string poly(const std::string& id, const Points& points, const std::string& params = "",
                 const std::string& type = "building") {
  std::string shape;
  for (const auto& [x, y] : points) shape += fmt::format("{:.2f},{:.2f} ", x, y);
  return fmt::format("<poly id=\"{}\" type=\"{}\" shape=\"{}{:.2f},{:.2f}\">{}</poly>\n", id, type, shape,
                     points[0].first, points[0].second, params);
}
std::string param(const std::string& key, const std::string& value) {
  return fmt::format("<param key=\"{}\" value=\"{}\"/>", key, value);
}
std::string file(const std::string& content) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- made for a test -->\n<additional>\n" + content +
         "</additional>\n";
}
const std::string utm_location =
    "<location netOffset=\"-691467.19,-5334730.98\" convBoundary=\"0,0,200,40\" origBoundary=\"0,0,1,1\" "
    "projParameter=\"+proj=utm +zone=32 +ellps=WGS84 +datum=WGS84 +units=m +no_defs\"/>\n";

}  // namespace

TEST_CASE("a courtyard is a polygon inside of another with the same tags, a house in it a third") {
  const std::string tags = param("building", "yes") + param("building:levels", "4");
  const TemporaryFolder folder;
  const auto [summary, scene] =
      import_text(file(poly("Gebäude 1", rectangle(0, 0, 50, 40), tags) + poly("2", rectangle(10, 10, 40, 30), tags) +
                       poly("3", rectangle(20, 15, 30, 25), tags) +
                       poly("4", rectangle(2, 2, 8, 8), param("building", "yes") + param("height", "20"))),
                  folder);
  CHECK(summary.buildings == 3);
  CHECK(summary.courtyards == 1);
  CHECK(volume_m3(scene, "polygon_1 Gebäude 1") == doctest::Approx((2000 - 600) * 13).epsilon(1e-9));
  CHECK(volume_m3(scene, "polygon_3 3") == doctest::Approx(100 * 13).epsilon(1e-9));
  CHECK(top_m(scene, "polygon_4 4") == 20);  // other tags: a building of its own
  CHECK(summary.offset_m == glm::dvec2(0, 0));
  CHECK_FALSE(find_georeference(summary.scene));
}

TEST_CASE("coordinates stay those of the network, and georeference.json knows its offset") {
  const TemporaryFolder folder;
  const auto [summary, scene] = import_text(
      file(utm_location + poly("a", rectangle(100, 10, 120, 30)) + poly("b", rectangle(0, 0, 5, 5), "", "water")),
      folder);
  CHECK(summary.lower_m == glm::dvec2(100, 10));
  CHECK(summary.upper_m == glm::dvec2(120, 30));
  CHECK(summary.left_out.at("polygon of the type 'water'") == 1);
  const auto reference = find_georeference(summary.scene);
  REQUIRE(reference);
  CHECK(reference->offset_m == glm::dvec2(-691467.19, -5334730.98));
  CHECK(summary.attribution.empty());
}

TEST_CASE("UTM coordinates without an offset are moved by whole metres, which describe() tells") {
  const TemporaryFolder folder;
  const auto [summary, scene] =
      import_text(file(poly("a", rectangle(691467.25, 5334730.5, 691487.25, 5334750.5), param("height", "9"))), folder);
  CHECK(summary.offset_m == glm::dvec2(-691477, -5334741));
  CHECK(summary.lower_m == glm::dvec2(691467.25 - 691477, 5334730.5 - 5334741));
  CHECK(volume_m3(scene, "polygon_1") == doctest::Approx(4000).epsilon(1e-9));
  CHECK(describe(summary).find("offset_m = [-691477, -5334741, 0]") != std::string::npos);
}

TEST_CASE("shapes with heights, geographic shapes, parts") {
  const TemporaryFolder folder;
  const auto plain =
      import_text(file("<poly id=\"a\" type=\"building.yes\" shape=\"0,0,5 10,0,5 10,10,5 0,10,5\"/>"), folder);
  CHECK(volume_m3(plain.scene, "polygon_1") == doctest::Approx(1100).epsilon(1e-9));
  // Corners of a square that polyconvert placed at (109.81, 13.68), in degrees.
  const auto geo =
      import_text(file(utm_location + "<poly id=\"g\" type=\"building\" geo=\"1\" shape=\"11.575134,48.137090 "
                                      "11.575403,48.137090 11.575403,48.137180 11.575134,48.137180\"/>"),
                  folder);
  CHECK(geo.summary.lower_m.x == doctest::Approx(109.5).epsilon(0.01));
  const auto parts = import_text(
      file(poly("o", rectangle(0, 0, 20, 20)) + poly("p", rectangle(0, 0, 10, 20), "", "building:part")), folder);
  CHECK(parts.summary.parts == 1);
  CHECK(parts.summary.buildings == 0);
}

TEST_CASE("what cannot be read is named with its line") {
  const TemporaryFolder folder;
  for (const char* shape : {"1", "1,2,3,4 5,6", "a,b", "1,2 nan,3", "1,2 3,inf", "1;2", "1,,2"}) {
    const std::string text = file("\n<poly id=\"a\" type=\"building\" shape=\"" + std::string(shape) + "\"/>");
    CAPTURE(shape);
    CHECK_THROWS_WITH_AS(import_text(text, folder), doctest::Contains("map:5: <poly id=\"a\">"), InputError);
  }
  CHECK_THROWS_WITH_AS(import_text("<additional><poly", folder), doctest::Contains("not well-formed XML"), InputError);
  CHECK_THROWS_WITH_AS(import_text(file("<location netOffset=\"x\"/>"), folder), doctest::Contains("netOffset"),
                       InputError);
  CHECK_THROWS_WITH_AS(import_text(file("<poly id=\"a\" type=\"building\" geo=\"1\" shape=\"1,2\"/>"), folder),
                       doctest::Contains("<location>"), InputError);
  CHECK_THROWS_WITH_AS(
      import_text(file(poly("a", rectangle(0, 0, 5, 5)) + poly("b", rectangle(90000, 0, 90005, 5))), folder),
      doctest::Contains("cut a part"), InputError);
}
