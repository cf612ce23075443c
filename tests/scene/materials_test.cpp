// SPDX-License-Identifier: Apache-2.0
// Radio materials: the table, and the precedence of alias, configuration, file and table.
// Values of the table are spot-checked against ITU-R P.2040-3 and P.2040-4, Table 3.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "one_mesh.hpp"
#include "scene/materials.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;
using test::named;
using test::one_mesh;

namespace {

using Field = std::optional<double> MaterialConfig::*;

// A [[material]] table with these fields.
MaterialConfig table(const std::string& name, std::initializer_list<std::pair<Field, double>> fields = {}) {
  MaterialConfig out;
  out.name = name;
  for (const auto& [field, value] : fields) out.*field = value;
  return out;
}

Material resolve(const RawMaterial& material, const std::vector<MaterialConfig>& overrides = {},
                 const SceneConfig& scene = {}, double frequency_hz = 5.9e9) {
  return resolve_materials(one_mesh(material), scene, overrides, frequency_hz).materials.at(0);
}

}  // namespace

TEST_CASE("the ITU table") {
  CHECK(itu_materials("P.2040-3").size() == 17);
  CHECK(itu_materials("P.2040-4").size() == 38);
  const Material ground = resolve(named("itu_medium_dry_ground"));
  CHECK(ground == Material{"medium_dry_ground", 15, -0.1, 0.035, 1.63, 1, 10, 0.1});
  CHECK(resolve(named("mat-itu_concrete")) == Material{"concrete", 5.24, 0, 0.0462, 0.7822, 1, 100, 0.1});
  CHECK(resolve(named("asphalt_concrete")).d == 1.3969);
  CHECK(resolve(named("glass")).a == 6.31);
  CHECK(resolve(named("glass"), {}, {}, 300e9).a == 5.79);
  CHECK(resolve(named("glass"), {}, {}, 150e9).a == 6.5767);  // since P.2040-4
  SceneConfig older;
  older.itu_edition = "P.2040-3";
  CHECK(resolve(named("glass"), {}, older, 150e9).max_ghz == 450);  // outside both: the evaluation will refuse
}

TEST_CASE("the editions of ITU-R P.2040: below 100 GHz they differ in what they have, never in a value") {
  for (const Material& law : itu_materials("P.2040-3")) {
    CAPTURE(law.name);
    CHECK(std::ranges::count(itu_materials("P.2040-4"), law) == 1);
  }
  std::vector<std::string> added;
  for (const Material& law : itu_materials("P.2040-4"))
    if (law.max_ghz <= 100 && std::ranges::count(itu_materials("P.2040-3"), law) == 0) added.push_back(law.name);
  CHECK(added == std::vector<std::string>{"vinyl_tile", "carpet_tile", "asphalt_concrete"});
  SceneConfig older;
  older.itu_edition = "P.2040-3";
  CHECK_THROWS_WITH_AS(resolve(named("vinyl_tile"), {}, older),
                       Contains("'vinyl_tile' is not known to ITU-R P.2040-3 (scene.itu_edition), but to P.2040-4"),
                       InputError);
  CHECK(resolve(named("itu_carpet_tile")) == Material{"carpet_tile", 2.08, 0, 0.0009, 0.82, 1, 40, 0.1});
  // Rows of P.2040-4 as Sionna RT 2.2 prints them: name, GHz, a, c, d.
  const struct {
    const char* name;
    double ghz, a, c, d;
  } rows[] = {{"concrete", 200, 5.17, 0.0145, 1.09},         {"brick", 110, 4.15, 0.0006, 1.5712},
              {"clear_acrylic", 330, 2.58, 0.0001, 1.6524},  {"chipboard", 150, 2.16, 0.0023, 1.359},
              {"marble", 380, 8.62, 0.0027, 1.15},           {"floorboard", 250, 5.27, 2.22e-17, 7.3413},
              {"floorboard", 350, 5.27, 0.0003, 2.0298},     {"floorboard", 425, 5.27, 49.8726, 0},
              {"floorboard", 150, 3.1575, 0.001675, 1.32775}};
  for (const auto& row : rows) {
    CAPTURE(row.name);
    const Material m = resolve(named(row.name), {}, {}, row.ghz * 1e9);
    CHECK(m.a == row.a);
    CHECK(m.c == row.c);
    CHECK(m.d == row.d);
  }
}

TEST_CASE("laws that overlap: the narrower range, with a warning; each ordered so in the table") {
  const auto warnings = [](const char* name, double ghz) {
    return resolve_materials(one_mesh(named(name)), {}, {}, ghz * 1e9).warnings;
  };
  CHECK(warnings("glass", 5.9).empty());
  CHECK(warnings("glass", 150).empty());
  REQUIRE(warnings("glass", 300).size() == 1);
  CHECK(warnings("glass", 300)[0] ==
        "ITU-R P.2040-4 has 2 laws of \"glass\" at 300 GHz (220 to 450 GHz, 100 to 400 GHz): "
        "that of 220 to 450 GHz is used, because its range is narrower; a [[material]] with a, b, "
        "c and d takes another one");
  const std::vector<Material>& all = itu_materials("P.2040-4");
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t k = i + 1; k < all.size(); ++k) {
      if (all[i].name != all[k].name || all[i].max_ghz < all[k].min_ghz || all[k].max_ghz < all[i].min_ghz) continue;
      CAPTURE(all[i].name);
      CHECK(all[i].max_ghz - all[i].min_ghz < all[k].max_ghz - all[k].min_ghz);
    }
}

TEST_CASE("beyond the range that a material was measured in") {
  SceneConfig beyond;
  beyond.extrapolate_materials = true;
  CHECK(resolve(named("brick"), {}, {}, 60e9).max_ghz == 40);  // the evaluation will refuse
  const ResolvedMaterials brick = resolve_materials(one_mesh(named("brick")), beyond, {}, 60e9);
  CHECK(brick.materials[0].a == 3.91);  // the nearer range, by the ratio: 40 to 60, not 60 to 110
  CHECK(std::isinf(brick.materials[0].max_ghz));
  REQUIRE(brick.warnings.size() == 1);
  CHECK(brick.warnings[0].find("\"brick\" was measured from 1 to 40 GHz, and is used at 60 GHz") != std::string::npos);
  CHECK(resolve(named("brick"), {}, beyond, 80e9).a == 4.15);
  CHECK(resolve(named("brick"), {}, beyond, 5.9e9).max_ghz == 40);  // in its range nothing is lifted
  MaterialConfig own_law = table("brick", {{&MaterialConfig::permittivity, 4}});
  CHECK(resolve_materials(one_mesh(named("brick")), beyond, {own_law}, 60e9).warnings.empty());
  CHECK(resolve(named("marble"), {}, {}, 60e9).max_ghz == 60);
  CHECK(resolve_materials(one_mesh(named("marble")), beyond, {}, 60e9).warnings.empty());  // 60 GHz is in the range
  for (const char* ground : {"very_dry_ground", "medium_dry_ground", "wet_ground"}) {
    CAPTURE(ground);
    CHECK(resolve(named(ground), {}, beyond, 60e9).max_ghz == 10);
  }
}

TEST_CASE("a material of the library under a name of one's own") {
  MaterialConfig facade = table("facade");
  facade.library = "itu_brick";
  CHECK(resolve(named("facade"), {facade}) == Material{"facade", 3.91, 0, 0.0238, 0.16, 1, 40, 0.1});
  facade.thickness_m = 0.3;
  facade.scattering = 0.2;
  const Material thick = resolve(named("mat-facade"), {facade});
  CHECK(thick.thickness_m == 0.3);
  CHECK(thick.scattering == 0.2);
  CHECK(thick.max_ghz == 40);
  facade.conductivity_s_m = 0.1;
  CHECK(resolve(named("facade"), {facade}).c == 0.1);
  CHECK(resolve(named("facade"), {facade}).a == 3.91);
  MaterialConfig concrete = table("concrete");  // also of a name that the library has
  concrete.library = "marble";
  CHECK(resolve(named("concrete"), {concrete}) == Material{"concrete", 7.074, 0, 0.0055, 0.9262, 1, 60, 0.1});
  MaterialConfig wrong = table("facade");
  wrong.library = "bricks";
  CHECK_THROWS_WITH_AS(resolve(named("facade"), {wrong}),
                       Contains("[[material]] 'facade': library = 'bricks' is not a material; known: vacuum, concrete"),
                       ConfigError);
}

TEST_CASE("aliases map names with and without prefixes") {
  SceneConfig scene;
  scene.material_alias = {{"Facade.001", "itu_brick"}, {"tiles", "mine"}};
  CHECK(resolve(named("Facade.001"), {}, scene).name == "brick");
  CHECK(resolve(named("mat-Facade.001"), {}, scene).name == "brick");
  MaterialConfig mine = table("mine");
  mine.permittivity = 3;
  CHECK(resolve(named("tiles"), {mine}, scene) == Material{.name = "mine", .a = 3});
  scene.material_alias["Facade.001"] = "bricks";
  CHECK_THROWS_WITH_AS(resolve(named("Facade.001"), {}, scene), Contains("is mapped to 'bricks', which is not a known"),
                       ConfigError);
}

TEST_CASE("the configuration overrides table and file, field by field") {
  MaterialConfig thick = table("concrete");
  thick.thickness_m = std::numeric_limits<double>::infinity();
  Material m = resolve(named("itu_concrete"), {thick});
  CHECK(m.thickness_m == std::numeric_limits<double>::infinity());
  CHECK(m.a == 5.24);
  CHECK(m.max_ghz == 100);
  MaterialConfig fixed = table("concrete");
  fixed.permittivity = 4;
  fixed.conductivity_s_m = 0.01;
  m = resolve(named("concrete"), {fixed});
  CHECK(m == Material{.name = "concrete", .a = 4, .b = 0, .c = 0.01, .d = 0});
  MaterialConfig law = table("brick");
  law.c = 0.03;
  m = resolve(named("brick"), {law});
  CHECK(m.a == 3.91);
  CHECK(m.c == 0.03);
  CHECK(m.d == 0.16);
  // The file's own definition: the configuration's thickness overrides it, for its ITU type and its own name.
  RawMaterial facade = named("mat-facade");
  facade.itu_type = "concrete";
  facade.thickness_m = 0.3;
  CHECK(resolve(facade).thickness_m == 0.3);
  CHECK(resolve(facade).name == "facade");
  CHECK(resolve(facade, {thick}).thickness_m == std::numeric_limits<double>::infinity());
  MaterialConfig own = table("facade");
  own.thickness_m = 0.5;
  CHECK(resolve(facade, {thick, own}).thickness_m == 0.5);
}

TEST_CASE("equal materials are one, unused names are warnings") {
  RawScene raw = one_mesh(named("mat-itu_wood"));
  raw.materials.push_back(named("wood"));
  raw.materials.push_back(named("marble"));
  for (uint32_t i : {1u, 2u, no_material}) raw.meshes.push_back({"m", "m.ply", {}, {}, i});
  SceneConfig scene;
  scene.default_material = "itu_wood";
  scene.material_alias["roof"] = "metal";
  MaterialConfig over = table("plywood");
  over.thickness_m = 0.02;
  const ResolvedMaterials resolved = resolve_materials(raw, scene, {over}, 5.9e9);
  CHECK(resolved.materials.size() == 2);
  CHECK(resolved.mesh_material == std::vector<uint32_t>{0, 0, 1, 0});
  REQUIRE(resolved.warnings.size() == 2);
  CHECK(resolved.warnings[0].find("'roof' = 'metal'") != std::string::npos);
  CHECK(resolved.warnings[1].find("'plywood'") != std::string::npos);
}

TEST_CASE("vegetation is refused what only a surface has, and a surface what only leaves have") {
  const auto hedge = [](std::initializer_list<std::pair<Field, double>> fields) {
    MaterialConfig out = table("hedge", fields);
    out.vegetation = "mixed";
    return out;
  };
  const auto refuses = [](const MaterialConfig& material, const char* message) {
    CHECK_THROWS_WITH_AS(resolve(named(material.name), {material}), message, ConfigError);
  };
  constexpr const char* no_surface =
      "[[material]] 'hedge': vegetation is no surface, and has no permittivity, thickness, scattering_lobe, "
      "library or layers: remove those keys";
  for (const Field field : {&MaterialConfig::scattering_lobe, &MaterialConfig::thickness_m,
                            &MaterialConfig::permittivity, &MaterialConfig::conductivity_s_m, &MaterialConfig::a,
                            &MaterialConfig::b, &MaterialConfig::c, &MaterialConfig::d})
    refuses(hedge({{field, 4}}), no_surface);
  MaterialConfig bark = hedge({});
  bark.library = "wood";
  refuses(bark, no_surface);
  constexpr const char* no_leaves =
      "[[material]] 'brick': attenuation_db_m, max_attenuation_db and in_leaf need vegetation = \"mixed\" "
      "or \"deciduous\"";
  refuses(table("brick", {{&MaterialConfig::attenuation_db_m, 1}}), no_leaves);
  refuses(table("brick", {{&MaterialConfig::max_attenuation_db, 30}}), no_leaves);
  MaterialConfig bare = table("brick");
  bare.in_leaf = false;
  refuses(bare, no_leaves);
  // Vegetation does use these keys, including the two of its scattering.
  CHECK(resolve(named("hedge"), {hedge({{&MaterialConfig::scattering, 0.6},
                                        {&MaterialConfig::scattering_cross_polar, 0.2},
                                        {&MaterialConfig::attenuation_db_m, 1}})})
            .vegetation.has_value());
}

TEST_CASE("material errors") {
  const auto fails = [](MaterialConfig m, const char* message) {
    CAPTURE(message);
    CHECK_THROWS_WITH_AS(resolve(named("brick"), {m}), Contains(message), ConfigError);
  };
  fails(table(""), "name is missing");
  fails(table("brick", {{&MaterialConfig::a, 2}, {&MaterialConfig::permittivity, 3}}), "not both");
  fails(table("brick", {{&MaterialConfig::permittivity, 0.5}}), "permittivity must be 1 or more");
  fails(table("brick", {{&MaterialConfig::conductivity_s_m, -1}}), "negative");
  fails(table("brick", {{&MaterialConfig::thickness_m, 0}}), "thickness_m must be positive");
  fails(table("brick", {{&MaterialConfig::a, std::numeric_limits<double>::quiet_NaN()}}), "finite");
  CHECK_THROWS_WITH_AS(resolve(named("brick"), {table("x"), table("x")}), Contains("defined twice"), ConfigError);
  CHECK_THROWS_WITH_AS(resolve(named("mud"), {table("mud", {{&MaterialConfig::thickness_m, 1}})}),
                       Contains("needs permittivity"), ConfigError);
  CHECK_THROWS_WITH_AS(resolve(named("mud")), Contains("wall.ply: mesh 'wall': the material 'mud' is not known"),
                       InputError);
  SceneConfig scene;
  scene.default_material = "mud";
  RawScene raw = one_mesh(named("brick"));
  raw.meshes[0].material = no_material;
  CHECK_THROWS_WITH_AS(resolve_materials(raw, scene, {}, 1e9), Contains("scene.default_material: the material 'mud'"),
                       InputError);
}
