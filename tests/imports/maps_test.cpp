// SPDX-License-Identifier: Apache-2.0
// Maps and terrain by GDAL: files that ogr2ogr and gdal_translate wrote, compared with the data that were put into
// them. Without the module or the programs (Debian: gdal-bin) the cases say so and are skipped.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>

#include "base/file.hpp"
#include "folders.hpp"
#include "imported.hpp"
#include "map_files.hpp"
#include "scene/georeference.hpp"
#include "scene/ground.hpp"
#include "scene/load.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
namespace fs = std::filesystem;

namespace {

// A house, one with a courtyard and storeys alone, two houses of one feature, a tree, and an outline that crosses
// itself.
std::string town() {
  const auto list = [](const std::string& text) { return "[" + text + "]"; };
  const std::string yard = ring(rectangle(-60, 10, -12, 50)) + ", " + ring(rectangle(-50, 20, -22, 40));
  const std::string pair = list(ring(rectangle(40, 0, 50, 10))) + ", " + list(ring(rectangle(40, 20, 50, 30)));
  return R"({"type": "FeatureCollection", "features": [)" +
         feature("Polygon", list(ring(rectangle(10, 10, 30, 22))),
                 R"("h_m": 12.5, "floors": null, "name": "Bäckerei", "kind": 1)") +
         ",\n" + feature("Polygon", list(yard), R"("h_m": null, "floors": 4)") + ",\n" +
         feature("MultiPolygon", list(pair), R"("h_m": 7, "floors": 9)") + ",\n" +
         feature("Polygon", list(ring({{70, 0}, {80, 10}, {80, 0}, {70, 12}})), R"("h_m": 5)") + ",\n" +
         feature("Point", "[11.575, 48.137]", R"("h_m": 5)") + "]}\n";
}

}  // namespace

TEST_CASE("one town in the formats of many programs is one scene") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  const fs::path json = folder.write("town.geojson", town());
  const auto converted = [&](const std::string& name, const std::string& options) {
    const fs::path file = folder.path() / name;
    REQUIRE(run(fmt::format("{} {} '{}' '{}'", WAVETRACER_OGR2OGR, options, file.string(), json.string())));
    return file;
  };
  const std::string polygons = "-where \"OGR_GEOMETRY='POLYGON' OR OGR_GEOMETRY='MULTIPOLYGON'\" -nlt PROMOTE_TO_MULTI";
  const std::vector<fs::path> files = {
      json,
      converted("town.gpkg", ""),
      converted("utm.gpkg", "-t_srs EPSG:25832"),
      converted("town.fgb", polygons),
      converted("town.shp", polygons),
      converted("town.gml", "-f GML"),
      converted("town.kml", "-f LIBKML"),
  };
  for (const fs::path& file : files) {
    CAPTURE(file.string());
    CHECK(is_import(file));
    const Imported city = import_file(file, fields());
    CHECK(city.summary.buildings == 4);
    CHECK(city.summary.courtyards == 1);
    if (file.extension() != ".kml")  // which ogr2ogr writes without it
      CHECK(city.summary.left_out.at("outline that crosses or touches itself") == 1);
    const double base_m = 1;  // foundation below the ground
    CHECK(volume_m3(city.scene, "feature_") ==
          doctest::Approx(240 * (12.5 + base_m) + (48 * 40 - 28 * 20) * (12 + base_m) + 2 * 100 * (7 + base_m))
              .epsilon(1e-4));
    const auto place = find_georeference(city.summary.scene);
    REQUIRE(place);
    // The middle of the house, to a millimetre where the format keeps so much.
    const Projection here(*place), there(middle);
    const glm::dvec2 wanted = here.scene(there.geographic({45, 30}));
    double nearest = 1e9;
    for (const glm::dvec3& v : city.scene.vertices)
      nearest = std::min(nearest, glm::distance(glm::dvec2(city.scene.origin_m + v), wanted - glm::dvec2(5, 0)));
    CHECK(nearest < 2e-3);
  }
  CHECK(import_file(json, fields())
            .summary.left_out.at("point or line that is no tree (natural=tree, natural=tree_row)") == 1);
}

TEST_CASE("a map that is read has no new files beside it, and keeps the old ones") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  const fs::path json = folder.write("town.geojson", town()), gml = folder.path() / "town.gml";
  REQUIRE(run(fmt::format("{} -f GML '{}' '{}'", WAVETRACER_OGR2OGR, gml.string(), json.string())));
  fs::remove(folder.path() / "town.xsd");  // then GDAL looks for fields itself
  const fs::path schema = folder.path() / "town.gfs";
  REQUIRE_FALSE(fs::exists(schema));
  CHECK(import_file(gml, fields()).summary.buildings == 4);
  CHECK_FALSE(fs::exists(schema));
  folder.write("town.gfs", "<GMLFeatureClassList></GMLFeatureClassList>\n");
  import_file(json, fields());
  CHECK(read_file(schema.string()) == "<GMLFeatureClassList></GMLFeatureClassList>\n");
}

TEST_CASE("fields, layers and coordinate systems: what is missing is said with what there is") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  const fs::path json = folder.write("town.geojson", town());
  check_contains(refusal(json, fields("hoehe")),
                 "town.geojson: there is no field 'hoehe'; fields are h_m, floors, name");
  ImportOptions layer = fields();
  layer.layer = "houses";
  check_contains(refusal(json, layer), "it has no layer 'houses'; layers are town");
  ImportOptions none;
  const Imported guessed = import_file(json, none);
  REQUIRE(guessed.summary.warnings.size() == 1);
  check_contains(guessed.summary.warnings[0], "--height (metres) or --levels (storeys): h_m, floors, name");
  CHECK(guessed.summary.guessed.at("neither height nor levels given: default height used") == 4);
  check_contains(refusal(folder.write("no.map", "nothing"), none), "no.map: cannot be read as a map:");
  // One is a drawing in metres without a place, the other has degrees that are not declared.
  const auto csv = [&](const char* name, const char* wkt) {
    const fs::path file = folder.write(name, fmt::format("WKT,h_m\n\"{}\",8\n", wkt));
    const fs::path packed = file.string() + ".gpkg";
    REQUIRE(run(fmt::format("{} '{}' '{}'", WAVETRACER_OGR2OGR, packed.string(), file.string())));
    return packed;
  };
  const Imported drawing = import_file(csv("metres.csv", "POLYGON((0 0,500 0,500 20,0 20,0 0))"), fields("h_m", ""));
  CHECK_FALSE(find_georeference(drawing.summary.scene));
  CHECK(volume_m3(drawing.scene, "feature_") == doctest::Approx(500 * 20 * 9));
  check_contains(drawing.summary.warnings.at(0), "does not name its coordinate system");
  check_contains(refusal(csv("degrees.csv", "POLYGON((11 48,11.1 48,11.1 48.1,11 48))"), none), "as small as degrees");
}

namespace {

constexpr double cell_m = 5;
constexpr int posts = 200;

double hills_m(double x, double y) {
  return 520 + 40 * std::sin(x / 150) + 25 * std::cos(y / 97) + 3 * std::sin(x / 13);
}

// A raster of hills about the middle in UTM, written as text and made a GeoTIFF by gdal_translate.
struct HillRaster {
  fs::path file;
  glm::dvec2 corner;  // corner of the first pixel, lower left
  Projection utm{{"+proj=utm +zone=32 +ellps=WGS84 +units=m", {0, 0}, {}, {}}};

  explicit HillRaster(const TemporaryFolder& folder) {
    const glm::dvec2 centre = utm.scene({11.575, 48.137});
    corner = glm::round(centre) - 0.5 * cell_m * posts;
    std::string text =
        fmt::format("ncols {0}\nnrows {0}\nxllcorner {1:.3f}\nyllcorner {2:.3f}\ncellsize {3}\nNODATA_value -9999\n",
                    posts, corner.x, corner.y, cell_m);
    for (int row = posts - 1; row >= 0; --row)
      for (int column = 0; column < posts; ++column)
        text += column == 7 && row == 9 ? "-9999 " : fmt::format("{:.4f} ", hills_m(at(column), at(row)));
    const fs::path ascii = folder.write("hills.asc", text);
    file = folder.path() / "hills.tif";
    REQUIRE(
        run(fmt::format("{} -a_srs EPSG:32632 '{}' '{}'", WAVETRACER_GDAL_TRANSLATE, ascii.string(), file.string())));
  }
  // Returns the coordinate of a post, from the corner.
  static double at(double index) { return (index + 0.5) * cell_m; }
};

}  // namespace

TEST_CASE("a GeoTIFF of hills: the ground misses no post by more than its error, and houses stand on it") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  const HillRaster raster(folder);
  ImportOptions options = fields();
  options.terrain = raster.file;
  options.margin_m = 300;
  const Imported city = import_file(folder.write("town.geojson", town()), options);
  REQUIRE(city.summary.terrain);
  CHECK(city.summary.terrain->largest_error_m <= 0.3);
  CHECK(city.summary.terrain->largest_error_m > 0.2);
  CHECK(city.summary.terrain->triangles < city.summary.terrain->posts / 4);
  const auto place = find_georeference(city.summary.scene);
  REQUIRE(place);
  CHECK(place->elevation_m == 0);
  const Projection here(*place);
  const Ground ground(city.scene);
  double worst_post_m = 0, worst_between_m = 0;
  int inside = 0;
  for (int row = 0; row < 4 * posts; ++row)
    for (int column = 0; column < 4 * posts; ++column) {
      const glm::dvec2 from_corner{HillRaster::at(column / 4.0), HillRaster::at(row / 4.0)};
      const glm::dvec2 p = here.scene(raster.utm.geographic(raster.corner + from_corner));
      const auto z = ground.height_m(p);
      const double error_m = z ? std::abs(*z - hills_m(from_corner.x, from_corner.y)) : 0;
      inside += z.has_value();
      worst_between_m = std::max(worst_between_m, error_m);
      if (row % 4 == 0 && column % 4 == 0) worst_post_m = std::max(worst_post_m, error_m);
    }
  CHECK(inside > 200000);
  CHECK(worst_post_m <= 0.3 + 0.01);  // and vertices on the grid of 1/1024 m, on slopes
  CHECK(worst_between_m <= 0.5);      // between posts, where the raster has no value
  // The house of 12.5 m: its floor is 1 m below the lowest ground along its outline.
  double lowest_m = 1e9;
  const Projection there(middle);
  for (double x = 10; x <= 30; x += 0.1)
    for (double y = 10; y <= 22; y += 0.1)
      if (x == 10 || x > 29.95 || y == 10 || y > 21.95)
        lowest_m = std::min(lowest_m, *ground.height_m(here.scene(there.geographic({x, y}))));
  CHECK(bottom_m(city.scene, "feature_0 ") == doctest::Approx(lowest_m - 1).epsilon(1e-4));
  CHECK(top_m(city.scene, "feature_0 ") == doctest::Approx(lowest_m + 12.5).epsilon(1e-4));
}

TEST_CASE("a terrain of the wrong place, without coordinates, or with gaps") {
  if (!has_gdal()) return;
  const TemporaryFolder folder;
  const HillRaster raster(folder);
  const fs::path json = folder.write("town.geojson", town());
  ImportOptions options = fields();
  const auto translated = [&](const std::string& name, const std::string& how) {
    options.terrain = folder.path() / name;
    REQUIRE(run(fmt::format("{} {} '{}' '{}'", WAVETRACER_GDAL_TRANSLATE, how, raster.file.string(),
                            options.terrain.string())));
  };
  translated("far.tif", "-a_ullr 300000 5400000 301000 5399000");
  check_contains(refusal(json, options), "far.tif: cannot be used as a terrain: the map is outside of it");
  options.terrain = folder.path() / "hills.asc";
  check_contains(refusal(json, options), "does not name its coordinate system");
  options.terrain = json;
  check_contains(refusal(json, options), "town.geojson: cannot be used as a terrain");
  options.terrain = raster.file;
  options.margin_m = 2000;  // beyond the raster, with its one gap
  const Imported city = import_file(json, options);
  CHECK(city.summary.warnings.size() == 2);
  check_contains(city.summary.warnings.at(0), "1 posts in the area have no height");
  check_contains(city.summary.warnings.at(1), "does not cover the whole area");
}
