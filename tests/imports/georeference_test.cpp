// SPDX-License-Identifier: Apache-2.0
// Projections against coordinates that are known: the definition of UTM, lengths of a degree, a round trip.
#include "scene/georeference.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

TEST_CASE("UTM has its false easting on the central meridian, and 0.9996 of the equator's degrees") {
  const Projection utm({"+proj=utm +zone=32 +ellps=WGS84 +datum=WGS84 +units=m +no_defs", {-500000, 0}, ""});
  CHECK(std::abs(utm.scene({9, 0}).x) < 1e-6);
  CHECK(std::abs(utm.scene({9, 0}).y) < 1e-6);
  // One minute of the equator, 6378137 m * pi / 10800, times 0.9996.
  CHECK(utm.scene({9 + 1. / 60, 0}).x == doctest::Approx(1855.3248 * 0.9996).epsilon(1e-6));
  const glm::dvec2 place = utm.geographic(utm.scene({11.575, 48.137}));
  CHECK(std::abs(place.x - 11.575) < 1e-10);
  CHECK(std::abs(place.y - 48.137) < 1e-10);
}

TEST_CASE("georeference.json comes back as it was written") {
  const test::TemporaryFolder folder;
  CHECK_FALSE(find_georeference(folder.path() / "city.xml"));
  const Georeference written{
      "+proj=tmerc +lat_0=48.1 +lon_0=11.5 +ellps=WGS84 +units=m", {-691467.19, 1.0 / 3}, "(c) Straße"};
  write_georeference(folder.path() / "georeference.json", written);
  const auto read = find_georeference(folder.path() / "city.xml");
  REQUIRE(read);
  CHECK(read->projection == written.projection);
  CHECK(read->offset_m == written.offset_m);
  CHECK(read->attribution == written.attribution);
}

TEST_CASE("what is no projection and no georeference is said so") {
  for (const char* bad : {"", "!", "+proj=nonsense", "+proj=pipeline +step +proj=utm +zone=32", "+init=epsg:32632",
                          "+proj=hgridshift +grids=/etc/passwd", "EPSG:25832", "+proj=axisswap +order=2,1"}) {
    CAPTURE(std::string(bad));
    CHECK_THROWS_AS(Projection({bad, {0, 0}, ""}), InputError);
  }
  const Projection local({"+proj=tmerc +lat_0=48 +lon_0=11 +ellps=WGS84 +units=m", {0, 0}, ""});
  CHECK_THROWS_AS(local.scene({11, 1000}), InputError);
  for (const char* bad : {"", "{", "[]", "3", "{\"offset_m\": [0, 0]}", "{\"projection\": 3}",
                          "{\"projection\": \"+proj=utm\", \"offset_m\": [1]}",
                          "{\"projection\": \"+proj=utm\", \"offset_m\": [\"a\", 1]}"}) {
    CAPTURE(std::string(bad));
    const test::TemporaryFolder folder;
    folder.write("georeference.json", bad);
    CHECK_THROWS_AS(find_georeference(folder.path() / "city.xml"), InputError);
  }
}
