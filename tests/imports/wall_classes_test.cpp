// SPDX-License-Identifier: Apache-2.0
// Walls that have a class by their tags, and the tables that are written for them.
#include "imports/wall_classes.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "base/file.hpp"
#include "check_contains.hpp"
#include "imported.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using namespace wavetracer::imports;

namespace {

std::string wall_of(const Tags& tags) {
  std::map<std::string, uint64_t> guessed;
  return wall_class_of(tags, "concrete", guessed);
}

}  // namespace

TEST_CASE("the facade says more than the building, and its material more than its kind") {
  CHECK(wall_of({{"building:facade:material", "glass"}, {"building:material", "brick"}}) == "glass_wall");
  CHECK(wall_of({{"building:cladding", "metal"}, {"building:material", "brick"}}) == "metal_wall");
  CHECK(wall_of({{"building:material", "sandstone"}, {"building", "house"}}) == "stone_wall");
  CHECK(wall_of({{"building:facade:material", "velvet"}, {"building:material", "brick"}}) == "brick_wall");
  CHECK(wall_of({{"building", "warehouse"}}) == "metal_wall");
  CHECK(wall_of({{"building", "yes"}}) == "concrete_wall");
  CHECK(wall_of({{"building:material", "plywood"}}) == "plywood");  // there is no class of it
  std::map<std::string, uint64_t> guessed;
  wall_class_of({{"building", "house"}, {"building:material", "velvet"}}, "concrete", guessed);
  CHECK(guessed ==
        std::map<std::string, uint64_t>{{"material of a wall that ITU-R P.2040 does not have", 1},
                                        {"walls without a known material: brick_wall by the kind of building", 1}});
}

TEST_CASE("a scene with wall classes has their thickness, and tables that a user may change are kept") {
  OsmText map;
  map.way(rectangle(0, 0, 10, 10), {{"building", "house"}, {"height", "8"}});
  map.way(rectangle(20, 0, 30, 10), {{"building", "yes"}, {"height", "8"}, {"building:facade:material", "glass"}});
  const TemporaryFolder folder;
  ImportOptions options;
  const Imported plain = import_text(map.text(), folder, options);
  CHECK(plain.summary.materials.empty());
  for (const Material& material : plain.scene.materials) CHECK(material.thickness_m == 0.1);
  options.wall_classes = true;
  const auto [summary, scene] = import_text(map.text(), folder, options);
  CHECK(summary.walls == std::map<std::string, uint64_t>{{"brick_wall", 1}, {"glass_wall", 1}});
  std::map<std::string, double> thickness_m;
  for (const Material& material : scene.materials) thickness_m[material.name] = material.thickness_m;
  CHECK(thickness_m.size() == 3);
  CHECK(thickness_m.at("brick_wall") == 0.24);
  CHECK(thickness_m.at("glass_wall") == 0.008);
  CHECK(thickness_m.at("concrete") == 0.1);  // ground and roofs
  const std::string text = read_file(summary.materials);
  check_contains(text, "name = \"brick_wall\"\nlibrary = \"brick\"\nthickness_m = 0.24");
  check_contains(text, "layers = [{ material = \"glass\", thickness_m = 0.004 }, { material = \"vacuum\"");
  check_contains(describe(summary), "the [[material]] tables of ");
  CHECK(summary.warnings.empty());
  write_file(summary.materials, "# mine\n");
  options.output = summary.scene.parent_path();
  const ImportSummary again = import_city(map.text(), "map", options);
  REQUIRE(again.warnings.size() == 1);
  check_contains(again.warnings[0], "this file is kept as it is");
  CHECK(read_file(again.materials) == "# mine\n");
}

TEST_CASE("walls of concrete and wood lose what 3GPP TR 38.901, Table 7.4.3-1, has for them") {
  // The loss of a slab at normal incidence, without its echoes, dB. Conductivities are those of ITU-R P.2040 in S/m.
  const auto loss_db = [](double permittivity, double conductivity, double thickness_m) {
    const double root = std::sqrt(permittivity), reflected = (root - 1) / (root + 1);
    const double nepers_m = 0.5 * conductivity * 376.730313668 / root;
    return 20 / std::log(10.0) * nepers_m * thickness_m - 20 * std::log10(1 - reflected * reflected);
  };
  for (const double f : {2.0, 3.5, 5.9})
    CHECK(std::abs(loss_db(5.24, 0.0462 * std::pow(f, 0.7822), find_wall_class("concrete_wall")->thickness_m) -
                   (5 + 4 * f)) < 1);
  CHECK(std::abs(loss_db(1.99, 0.0047 * std::pow(5.9, 1.0718), find_wall_class("wood_wall")->thickness_m) -
                 (4.85 + 0.12 * 5.9)) < 0.5);
}
