// SPDX-License-Identifier: Apache-2.0
// The programs of users: osmium turns .osm into .pbf, netconvert and polyconvert make SUMO's network and polygons of
// the same map. All must give the same city. If a program is missing, its case is skipped.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "base/file.hpp"
#include "imported.hpp"
#include "scene/georeference.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

bool run(const std::string& command) { return std::system((command + " > /dev/null 2>&1").c_str()) == 0; }

// Streets, a courtyard, a house with a name that is not ASCII, a house with a height in feet.
std::string town() {
  OsmText map;
  map.way({{-100, 0}, {0, 0}, {100, 0}}, {{"highway", "residential"}, {"name", "Lärchenstraße"}}, false);
  map.way({{0, -80}, {0, 0}, {0, 80}}, {{"highway", "residential"}}, false);
  map.way(rectangle(10, 10, 30, 22), {{"building", "yes"}, {"height", "12 m"}, {"name", "Bäckerei Øst"}});
  map.way(rectangle(-40, -30, -12, -10), {{"building", "yes"}, {"height", "40 ft"}});
  const int outer = map.way(rectangle(-60, 10, -12, 50), {});
  const int inner = map.way(rectangle(-50, 20, -22, 40), {});
  map.relation({{outer, "outer"}, {inner, "inner"}}, {{"building", "yes"}, {"building:levels", "4"}});
  return map.text();
}

}  // namespace

TEST_CASE("osmium's PBF gives the same city as the XML that it was made of") {
  const std::string osmium = WAVETRACER_OSMIUM;
  if (osmium.empty()) {
    MESSAGE("skipped: no osmium (Debian: osmium-tool)");
    return;
  }
  const TemporaryFolder folder;
  const std::string xml = town();
  const auto osm = folder.write("town.osm", xml), pbf = folder.path() / "town.osm.pbf";
  REQUIRE(run(osmium + " cat '" + osm.string() + "' -o '" + pbf.string() + "'"));
  CHECK(is_import(osm));
  CHECK(is_import(pbf));
  const std::string packed = read_file(pbf);
  const Imported a = import_text(xml, folder), b = import_text(packed, folder);
  CHECK(a.summary.courtyards == 1);
  CHECK(a.scene.objects == b.scene.objects);
  CHECK(a.scene.vertices == b.scene.vertices);
  CHECK(a.scene.triangles == b.scene.triangles);
  // A damaged blob is refused, or the result is still a city.
  for (size_t i = 0; i < packed.size(); i += 7) {
    std::string damaged = packed;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x5A);
    ImportOptions options;
    options.output = folder.path() / "damaged";
    try {
      import_city(damaged, "damaged", options);
    } catch (const InputError&) {
    }
  }
}

TEST_CASE("polyconvert's polygons and the map itself, in the coordinates of netconvert's network, are one city") {
  const std::string netconvert = WAVETRACER_NETCONVERT, polyconvert = WAVETRACER_POLYCONVERT;
  if (netconvert.empty() || polyconvert.empty()) {
    MESSAGE("skipped: no netconvert and polyconvert (Debian: sumo)");
    return;
  }
  setenv("SUMO_HOME", "/usr/share/sumo", 0);
  const TemporaryFolder folder;
  const std::string xml = town();
  const std::string osm = folder.write("town.osm", xml).string(), base = (folder.path() / "town").string();
  REQUIRE(run(netconvert + " --osm-files '" + osm + "' -o '" + base + ".net.xml'"));
  const std::string to_polygons = polyconvert + " --net-file '" + base + ".net.xml' --osm-files '" + osm +
                                  "' --type-file $SUMO_HOME/data/typemap/osmPolyconvert.typ.xml";
  REQUIRE(run(to_polygons + " --all-attributes --osm.keep-full-type -o '" + base + ".poly.xml'"));
  REQUIRE(run(to_polygons + " -o '" + base + "_plain.poly.xml'"));
  CHECK(is_import(base + ".poly.xml"));
  CHECK_FALSE(is_import(base + ".net.xml"));

  const Imported polygons = import_text(read_file(base + ".poly.xml"), folder);
  CHECK(polygons.summary.buildings == 3);
  CHECK(polygons.summary.courtyards == 1);
  CHECK(polygons.summary.attribution.find("OpenStreetMap") != std::string::npos);
  // UTM shrinks lengths near its central meridian to 0.9996 of theirs, here 0.99975: areas by twice that.
  const double scale = 0.9996 * (1 + std::pow(191467.0 / 0.9996 / 6380000, 2) / 2);
  CHECK(std::abs(volume_m3(polygons.scene, "polygon") -
                 scale * scale * (240 * 13 + 560 * 13.192 + (48 * 40 - 28 * 20) * 13)) < 13 * 0.0085 * 450);

  ImportOptions options;
  options.net = base + ".net.xml";
  const Imported map = import_text(xml, folder, options);
  CHECK(glm::dvec2(map.summary.lower_m - polygons.summary.lower_m) == glm::dvec2(0, 0));
  CHECK(glm::dvec2(map.summary.upper_m - polygons.summary.upper_m) == glm::dvec2(0, 0));
  CHECK(volume_m3(map.scene, "way") + volume_m3(map.scene, "relation") ==
        doctest::Approx(volume_m3(polygons.scene, "polygon")).epsilon(1e-6));

  // Without attributes all heights are lost, the courtyard is not.
  const Imported plain = import_text(read_file(base + "_plain.poly.xml"), folder);
  CHECK(plain.summary.buildings == 3);
  CHECK(plain.summary.courtyards == 1);
  CHECK(plain.summary.guessed.at("neither height nor levels given: default height used") == 4);

  // The middle of the house is where the map has it.
  const auto reference = find_georeference(polygons.summary.scene);
  REQUIRE(reference);
  const glm::dvec2 corner = Projection(*reference).geographic(polygons.summary.upper_m);
  CHECK(std::abs(corner.x - 11.575) < 0.0015);
  CHECK(std::abs(corner.y - 48.137) < 0.0015);
}
