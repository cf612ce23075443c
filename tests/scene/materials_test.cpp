// Radio materials: the table, and who wins among alias, configuration, file and table.
// Values of the table are spot-checked against ITU-R P.2040-3, Table 3.
#include <doctest/doctest.h>

#include <limits>
#include <optional>

#include "scene/materials.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;

namespace {

RawScene one_mesh(const RawMaterial& material) {
  RawScene raw;
  raw.file = "scene.xml";
  raw.materials = {material};
  raw.meshes.push_back({"wall", "wall.ply", {}, {}, 0});
  return raw;
}

using Field = std::optional<double> MaterialConfig::*;

// A [[material]] table with these fields.
MaterialConfig table(const std::string& name, std::initializer_list<std::pair<Field, double>> fields = {}) {
  MaterialConfig out;
  out.name = name;
  for (const auto& [field, value] : fields) out.*field = value;
  return out;
}

RawMaterial named(const std::string& name) { return {name, "scene.xml:3", {}, {}, {}, {}}; }

Material resolve(const RawMaterial& material, const std::vector<MaterialConfig>& overrides = {},
                 const SceneConfig& scene = {}, double frequency_hz = 5.9e9) {
  return resolve_materials(one_mesh(material), scene, overrides, frequency_hz).materials.at(0);
}

}  // namespace

TEST_CASE("the ITU table") {
  CHECK(itu_materials().size() == 17);
  const Material ground = resolve(named("itu_medium_dry_ground"));
  CHECK(ground == Material{"medium_dry_ground", 15, -0.1, 0.035, 1.63, 1, 10, 0.1});
  CHECK(resolve(named("mat-itu_concrete")) == Material{"concrete", 5.24, 0, 0.0462, 0.7822, 1, 100, 0.1});
  CHECK(resolve(named("asphalt_concrete")).d == 1.3969);
  CHECK(resolve(named("glass")).a == 6.31);
  CHECK(resolve(named("glass"), {}, {}, 300e9).a == 5.79);
  CHECK(resolve(named("glass"), {}, {}, 150e9).max_ghz == 100);  // outside both: the evaluation will refuse
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
  // The file's own definition: its thickness yields to the configuration's, of its ITU type and of its own name.
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
