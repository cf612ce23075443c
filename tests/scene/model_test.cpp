// SPDX-License-Identifier: Apache-2.0
// OBJ and GLB through assimp, units, axes, and the choice of the reader.
// The GLB file is put together here from its parts, after section 4.4 of the glTF 2.0 specification.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <bit>
#include <cstdint>

#include "folders.hpp"
#include "scene/info.hpp"
#include "scene/model.hpp"
#include "scene_files.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;

namespace {

void put32(std::string& out, uint32_t bits) {
  for (unsigned shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>(bits >> shift & 0xFFu));
}

// One triangle (0 0 0) (2 0 0) (0 3 0) under two nodes: moved by (10, 20, 30), then doubled, glTF axes.
std::string triangle_glb() {
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
      R"("nodes":[{"scale":[2,2,2],"children":[1]},{"name":"sail","mesh":0,"translation":[10,20,30]}],)"
      R"("materials":[{"name":"cloth"}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],)"
      R"("buffers":[{"byteLength":44}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,3,0]},)"
      R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";
  while (json.size() % 4 != 0) json += ' ';
  std::string data;
  for (float x : {0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 3.f, 0.f}) put32(data, std::bit_cast<uint32_t>(x));
  put32(data, 1u << 16);  // indices 0, 1
  put32(data, 2);         // index 2 and padding
  std::string out = "glTF";
  put32(out, 2);
  put32(out, static_cast<uint32_t>(12 + 8 + json.size() + 8 + data.size()));
  put32(out, static_cast<uint32_t>(json.size()));
  out += "JSON" + json;
  put32(out, static_cast<uint32_t>(data.size()));
  return out + std::string("BIN\0", 4) + data;
}

const std::string obj =
    "o front\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nusemtl itu_glass\nf 1//1 2//1 3//1 4//1\n"
    "o side\nv 1 0 -1\nv 1 1 -1\nusemtl brickwork\nf 2 5 6 3\n";

}  // namespace

TEST_CASE("GLB: node transforms, y up, material names through the alias table") {
  const test::TemporaryFolder folder;
  SceneConfig config;
  config.material_alias["cloth"] = "wood";
  const auto file = folder.write("sail.glb", triangle_glb());
  Scene scene = load_scene_file(file, config);
  REQUIRE(scene.triangles.size() == 1);
  CHECK(scene.objects[0] == "sail");
  CHECK(scene.materials[0].name == "wood");
  // y up: (x, y, z) -> (x, -z, y), after 2 * (p + (10, 20, 30)).
  CHECK(scene.lower + scene.origin_m == glm::dvec3(20, -60, 40));
  CHECK(scene.upper + scene.origin_m == glm::dvec3(24, -60, 46));
  config.up = "z";
  config.scale = 0.5;
  scene = load_scene_file(file, config);
  CHECK(scene.lower + scene.origin_m == glm::dvec3(10, 20, 30));
  CHECK(scene.upper + scene.origin_m == glm::dvec3(12, 23, 30));
  CHECK_THROWS_WITH_AS(load_scene_file(file, {}), Contains("sail.glb: mesh 'sail': the material 'cloth' is not known"),
                       InputError);
}

TEST_CASE("OBJ: objects, materials without a library, quadrilaterals, scale") {
  const test::TemporaryFolder folder;
  SceneConfig config;
  config.material_alias["brickwork"] = "itu_brick";
  config.scale = 10;
  const Scene scene = load_scene_file(folder.write("corner.obj", obj), config);
  CHECK(scene.triangles.size() == 4);
  CHECK(scene.vertices.size() == 6);
  CHECK(scene.surfaces.size() == 2);
  CHECK(scene.report.free_edges == 6);
  CHECK(scene.edges.size() == 9);
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].name == "glass");
  CHECK(scene.materials[1].name == "brick");
  CHECK(scene.upper - scene.lower == glm::dvec3(10, 10, 10));
}

TEST_CASE("OBJ: what is no polygon is told or refused, with its line") {
  const test::TemporaryFolder folder;
  const std::string square = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nf 1 2 3 4\n";
  const auto warning = [&](const std::string& more) {
    const RawScene raw = read_model(folder.write("a.obj", square + more), ModelFormat::obj);
    REQUIRE(raw.warnings.size() == 1);
    CHECK(raw.meshes.at(0).triangles.size() == 2);
    return raw.warnings[0];
  };
  CHECK(warning("# p\nl 1 2\np 3\n").ends_with("a.obj:7: 2 lines and points were left out: they are no surfaces"));
  CHECK(warning("f 1 2\n").ends_with("a.obj:6: 1 faces of fewer than three vertices were left out"));
  CHECK(warning("cstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 4 3\nparm u 0 1\nend\n")
            .ends_with("a.obj:8: 1 curves and curved surfaces were left out: export them as polygons"));
  CHECK(warning("F 1 2 3\n").ends_with("a.obj:6: 1 statements 'F' are not known and were left out"));
  CHECK(warning("mtllib parts\\a.mtl\n").find("write / instead of \\") != std::string::npos);
  const auto refused = [&](const std::string& more, const char* message) {
    CHECK_THROWS_WITH_AS(read_model(folder.write("a.obj", square + more), ModelFormat::obj), Contains(message),
                         InputError);
  };
  refused("  v 0 0 5\n", "a.obj:6: blanks stand before 'v'");
  refused("v 0 0 1D3\n", "a.obj:6: 'v 0 0 1D3' is not a vertex of numbers");
  refused("call more.obj\n", "a.obj:6: 'call' reads another file");
  for (const char* plain : {"vt 0 0\nvn 0 0 1\ns off\ng a b\n", "f -4 -3 \\\n -2 -1\n", "v 0 0 0 1 0.5 0 # red\n",
                            "\n\t\n  # note\n", "mtllib gone.mtl\n"})
    CHECK(read_model(folder.write("a.obj", square + plain), ModelFormat::obj).warnings.empty());
}

TEST_CASE("models: errors and warnings") {
  const test::TemporaryFolder folder;
  const SceneConfig config = test::of_concrete();
  const auto load = [&](const char* name, const std::string& content) {
    load_scene_file(folder.write(name, content), config);
  };
  CHECK_THROWS_WITH_AS(load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), Contains("a.obj"), InputError);
  CHECK_THROWS_WITH_AS(load("b.obj", "v 0 0 0\n"), Contains("b.obj"), InputError);
  CHECK_THROWS_WITH_AS(load("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), Contains("nan.obj"), InputError);
  CHECK_THROWS_WITH_AS(load("c.glb", triangle_glb().substr(0, 200)), Contains("c.glb"), InputError);
  std::string huge = triangle_glb();
  huge.replace(12, 4, "\xff\xff\xff\xfe");  // the length of the JSON: 4 GB
  CHECK_THROWS_WITH_AS(load("huge.glb", huge), Contains("huge.glb: a chunk of 4278190079 bytes begins at byte 20"),
                       InputError);
  const auto nodes = [](const std::string& list) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + list + "}";
  };
  std::string doubled;
  for (int i = 1; i < 40; ++i) doubled += fmt::format("{}{{\"children\":[{},{}]}}", i > 1 ? "," : "[", i, i);
  CHECK_THROWS_WITH_AS(load("doubled.gltf", nodes(doubled + ",{}]")),
                       Contains("doubled.gltf: a node of '0' has two parents"), InputError);
  std::string chain, circle = "{\"children\":[1]},{\"children\":[0]}";
  for (int i = 1; i < 100000; ++i) chain += fmt::format("{{\"children\":[{}]}},", i);
  CHECK_THROWS_WITH_AS(load("chain.gltf", nodes("[" + chain + "{}]")),
                       Contains("chain.gltf: there are more than 1000 nodes one below the other"), InputError);
  CHECK_THROWS_WITH_AS(load("circle.gltf", nodes("[" + circle + "]")), Contains("circle.gltf: there are more than"),
                       InputError);
  CHECK_THROWS_WITH_AS(load("deep.gltf", nodes(std::string(1000000, '[') + std::string(1000000, ']'))),
                       Contains("deep.gltf: its JSON is nested deeper than 100"), InputError);
  // The file has a format that assimp knows by its first bytes, and that nobody asked for.
  CHECK_THROWS_WITH_AS(load("other.glb", "quick3Ds" + std::string(100, '\x7f')),
                       Contains("other.glb: is not a glTF file"), InputError);
  CHECK_THROWS_WITH_AS(load("none.gltf", "{\"nodes\":"), Contains("none.gltf: is not a glTF file"), InputError);
  CHECK_THROWS_WITH_AS(load("d.stl", "solid d\n"),
                       Contains("the file format is unknown; supported formats: Mitsuba XML"), InputError);
  CHECK_THROWS_WITH_AS(load("e.obj", ""), Contains("the file is empty"), InputError);
  CHECK_THROWS_WITH_AS(load("f.ply", "version https://git-lfs.github.com/spec/v1\n"), Contains("git lfs pull"),
                       InputError);
  CHECK_THROWS_WITH_AS(load_scene_file(folder.path(), config), Contains("is a folder"), InputError);
  CHECK_THROWS_WITH_AS(load_scene_file(folder.path() / "gone.xml", config), Contains("no such file"), InputError);
  const Scene far =
      load_scene_file(folder.write("utm.obj", "v 691000 0 0\nv 691100 0 0\nv 691000 100 0\nf 1 2 3\n"), config);
  REQUIRE(far.report.warnings.size() == 1);
  CHECK(far.report.warnings[0].find("float32 keeps only") != std::string::npos);
}

TEST_CASE("a house in millimetres gets a word, mountains and towers do not") {
  const test::TemporaryFolder folder;
  const auto warnings = [&](const std::string& content, double scale = 1) {
    SceneConfig config = test::of_concrete();
    config.scale = scale;
    return load_scene_file(folder.write("house.ply", content), config).report.warnings;
  };
  const std::string house = test::box_ply({0, 0, 0}, {10000, 12000, 8000});
  REQUIRE(warnings(house).size() == 1);
  CHECK(warnings(house)[0].starts_with("\"house\" has walls and is 8000 m high: is scene.scale right?"));
  CHECK(warnings(house, 0.001).empty());
  CHECK(warnings(test::box_ply({0, 0, 0}, {50, 50, 828})).empty());
  const auto mountain = [](const char* high) {
    return std::string(
               "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z\n"
               "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n9000 0 0\n9000 9000 0\n"
               "0 9000 0\n4500 4500 ") +
           high + "\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  };
  CHECK(warnings(mountain("4800")).empty());
  REQUIRE(warnings(mountain("12000")).size() == 1);
  CHECK(warnings(mountain("12000"))[0].starts_with("the scene is 12000 m high"));
  // Walls of many small triangles in one mesh.
  std::string wall =
      "ply\nformat ascii 1.0\nelement vertex 42\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 20\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 21; ++i) wall += "0 0 " + std::to_string(400 * i) + "\n9000 0 " + std::to_string(400 * i) + "\n";
  for (int i = 0; i < 20; ++i)
    wall += "4 " + std::to_string(2 * i) + " " + std::to_string(2 * i + 1) + " " + std::to_string(2 * i + 3) + " " +
            std::to_string(2 * i + 2) + "\n";
  CHECK(warnings(wall).size() == 1);
}

TEST_CASE("names with backslashes, and what TOML makes of them, get a hint") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "town");
  folder.write("town/a.ply", test::square_ply("4 0 1 2 3\n", 1));
  const std::string base = folder.path().string();
  for (const std::string& name : {base + "\\town\\a.ply", base + "\town\\a.ply"})
    CHECK_THROWS_WITH_AS(load_scene_file(name, test::of_concrete()),
                         Contains(("did you mean '" + base + "/town/a.ply'? write / instead of").c_str()), InputError);
  CHECK_THROWS_WITH_AS(load_scene_file(base + "/b\\c.ply", test::of_concrete()),
                       Contains("no such file; write / instead of"), InputError);
}

TEST_CASE("scene keys of the configuration") {
  const test::TemporaryFolder folder;
  Config config;
  CHECK_THROWS_WITH_AS(load_scene(config), Contains("no scene: set scene.file"), ConfigError);
  config.scene.file = folder.write("square", test::square_ply("4 0 1 2 3\n", 1)).string();  // known by its content
  config.scene.generate = "--seed 1";
  CHECK_THROWS_WITH_AS(load_scene(config), Contains("both scene.file and scene.generate"), ConfigError);
  config.scene.generate.clear();
  config.scene.default_material = "brick";
  CHECK(load_scene(config).surfaces.size() == 1);
  config.scene.scale = 0;
  CHECK_THROWS_WITH_AS(load_scene(config), Contains("scene.scale = 0"), ConfigError);
  config.scene.scale = 1;
  config.scene.up = "y";
  const Scene upright = load_scene(config);
  CHECK(upright.surfaces[0].normal == glm::dvec3(0, 1, 0));
  CHECK(upright.upper.z - upright.lower.z == 1);
}

TEST_CASE("the scenes that come with the program") {
  const std::filesystem::path folder = std::filesystem::path(test::source_folder()) / "configs/scenes";
  const Scene room = load_scene_file(folder / "room/room.xml", {});
  CHECK(room.triangles.size() == 12);
  CHECK(room.surfaces.size() == 6);
  CHECK(room.report.free_edges == 0);
  CHECK(room.materials[0].thickness_m == 0.2);
  const Scene corner = load_scene_file(folder / "corner/corner.obj", {});
  CHECK(corner.surfaces.size() == 3);
  CHECK(corner.materials.size() == 2);
  SceneConfig metal;
  metal.default_material = "metal";
  const Scene car = load_scene_file(folder / "car.ply", metal);
  CHECK(car.surfaces.size() == 10);
  CHECK(car.report.free_edges == 0);
  CHECK(describe_scene(car).find("surfaces   10, ") != std::string::npos);
}
