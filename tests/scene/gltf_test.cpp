// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 beyond plain triangles: extensions, modes, accessors of every kind, skins, morph targets, scenes.
// Files are put together here from their parts; where a mesh must be is computed by hand.
#include <doctest/doctest.h>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <glm/common.hpp>

#include "gltf_builder.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;
using nlohmann::json;
using test::Gltf;

namespace {

const std::vector<float> square_corners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

json primitive_of(Gltf& gltf) {
  return {{"attributes", {{"POSITION", gltf.positions(square_corners)}}},
          {"indices", gltf.accessor<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR", 1)}};
}

void check_at(glm::dvec3 p, glm::dvec3 q, double within = 1e-12) {
  for (int k = 0; k < 3; ++k) CHECK(std::abs(p[k] - q[k]) <= within);
}

bool warns(const RawScene& raw, const char* text) {
  for (const std::string& warning : raw.warnings)
    if (warning.find(text) != std::string::npos) return true;
  return false;
}

}  // namespace

TEST_CASE("EXT_mesh_gpu_instancing: every instance is there, below the transform of its node") {
  for (const bool required : {true, false}) {
    Gltf gltf;
    if (required) gltf.require("EXT_mesh_gpu_instancing");
    const json attributes = {
        {"TRANSLATION", gltf.positions({10, 0, 0, 10, 25, 0, 10, 0, 4})},
        {"ROTATION", gltf.accessor<int16_t>({0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, 32767}, "VEC4", 4, true)},
        {"SCALE", gltf.positions({1, 1, 1, 1, 1, 1, 2, 2, -2})}};
    gltf.mesh(primitive_of(gltf), {{"name", "house"},
                                   {"translation", {0, 0, 100}},
                                   {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    const RawScene raw = gltf.read();
    REQUIRE(raw.meshes.size() == 3);
    check_at(raw.meshes[0].vertices.at(2), {11, 1, 100});
    check_at(raw.meshes[1].vertices.at(2), {9, 26, 100});  // turned by 90 degrees about z
    check_at(raw.meshes[2].vertices.at(2), {12, 2, 104});
    for (const RawMesh& mesh : raw.meshes) CHECK(mesh.name == "house");
    CHECK(raw.warnings.empty());
  }
}

TEST_CASE("instances of different counts are refused") {
  Gltf gltf;
  const json attributes = {{"TRANSLATION", gltf.positions({10, 0, 0, 10, 25, 0})},
                           {"SCALE", gltf.positions({1, 1, 1})}};
  gltf.mesh(primitive_of(gltf), {{"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
  CHECK_THROWS_WITH_AS(gltf.read(), Contains("EXT_mesh_gpu_instancing have different counts"), InputError);
}

TEST_CASE("KHR_mesh_quantization: integers as positions, normalised or not, with strides") {
  Gltf gltf;
  gltf.require("KHR_mesh_quantization");
  const size_t bytes = gltf.accessor<int8_t>({0, 0, 0, 0, 127, 0, 0, 0, -127, 127, 0, 0}, "VEC3", 3, true);
  gltf.document["accessors"][bytes]["count"] = 3;
  gltf.document["bufferViews"].back()["byteStride"] = 4;
  gltf.mesh({{"attributes", {{"POSITION", bytes}}}}, {{"scale", {8, 8, 8}}, {"children", {1}}});
  gltf.mesh({{"attributes", {{"POSITION", gltf.accessor<uint16_t>({0, 0, 0, 300, 0, 0, 300, 65535, 0}, "VEC3", 3)}}}});
  gltf.mesh({{"attributes",
              {{"POSITION", gltf.accessor<uint16_t>({0, 0, 0, 65535, 0, 0, 65535, 65535, 0}, "VEC3", 3, true)}}}});
  gltf.document["scenes"][0]["nodes"] = {0, 2};
  const RawScene raw = gltf.read();
  REQUIRE(raw.meshes.size() == 3);
  check_at(raw.meshes[0].vertices.at(1), {8, 0, 0});
  check_at(raw.meshes[0].vertices.at(2), {-8, 8, 0});
  check_at(raw.meshes[1].vertices.at(2), {2400, 524280, 0});
  check_at(raw.meshes[2].vertices.at(2), {1, 1, 0});
}

TEST_CASE("KHR_draco_mesh_compression") {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const auto set = [&](int face, std::array<std::array<float, 3>, 3> corners) {
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<uint32_t>(face)), corners[0].data(),
                                      corners[1].data(), corners[2].data());
  };
  set(0, {{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}}});
  set(1, {{{0, 0, 0}, {8, 8, 0}, {0, 8, 0}}});
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::EncoderBuffer buffer;
  REQUIRE(draco::Encoder().EncodeMeshToBuffer(*mesh, &buffer).ok());
  Gltf gltf;
  gltf.require("KHR_draco_mesh_compression");
  const size_t view = gltf.view({buffer.data(), buffer.size()});
  const json compressed = {{"bufferView", view}, {"attributes", {{"POSITION", mesh->attribute(0)->unique_id()}}}};
  const size_t none = gltf.add("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  gltf.mesh({{"attributes", {{"POSITION", none}}}, {"extensions", {{"KHR_draco_mesh_compression", compressed}}}},
            {{"translation", {0, 0, 5}}});
  const RawScene raw = gltf.read();
  REQUIRE(raw.meshes.size() == 1);
  CHECK(raw.meshes[0].triangles.size() == 2);
  glm::dvec3 highest(0);
  for (const glm::dvec3& v : raw.meshes[0].vertices) highest = glm::max(highest, v);
  check_at(highest, {8, 8, 5}, 1e-6);
  gltf.data[8] = '\x55';
  CHECK_THROWS_WITH_AS(gltf.read(), Contains("compressed by KHR_draco_mesh_compression cannot be read"), InputError);
}

TEST_CASE("extensions: what is required and not read is refused by name, what is used and unknown is told") {
  for (const char* name : {"EXT_meshopt_compression", "CESIUM_RTC", "ACME_displacement"}) {
    Gltf gltf;
    gltf.mesh(primitive_of(gltf));
    gltf.document["extensionsUsed"].push_back(name);
    CHECK(gltf.read().meshes.size() == 1);
    CHECK(warns(gltf.read(), name) == (std::string(name) != "EXT_meshopt_compression"));
    gltf.document["extensionsRequired"].push_back(name);
    CHECK_THROWS_WITH_AS(gltf.read(), Contains(name), InputError);
    CHECK_THROWS_WITH_AS(gltf.read(), Contains("a.glb: it requires the extension"), InputError);
  }
  for (const char* name : {"KHR_texture_transform", "KHR_materials_variants", "KHR_materials_unlit",
                           "KHR_lights_punctual", "EXT_texture_webp", "KHR_texture_basisu", "MSFT_lod"}) {
    Gltf gltf;
    gltf.mesh(primitive_of(gltf));
    gltf.require(name);
    CHECK(gltf.read().warnings.empty());
  }
}

TEST_CASE("meshopt without its fallback is refused by name though not required") {
  Gltf gltf;
  gltf.mesh(primitive_of(gltf));
  json document = gltf.document;
  document["buffers"] =
      json::array({{{"byteLength", 90}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}});
  const test::TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_model(folder.write("a.gltf", document.dump()), ModelFormat::gltf),
                       Contains("its meshes are compressed by EXT_meshopt_compression"), InputError);
}

TEST_CASE("modes: strips and fans are triangles; points and lines are left out with a word") {
  const auto with_mode = [](int mode) {
    Gltf gltf;
    json primitive = {{"attributes", {{"POSITION", gltf.positions(square_corners)}}}, {"mode", mode}};
    if (mode == 5) primitive["indices"] = gltf.accessor<uint8_t>({0, 1, 3, 2}, "SCALAR", 1);
    gltf.mesh(primitive);
    return gltf.read();
  };
  CHECK(with_mode(4).meshes.at(0).triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(with_mode(5).meshes.at(0).triangles == std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}});
  CHECK(with_mode(6).meshes.at(0).triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  for (const int mode : {0, 1, 2, 3}) {
    const RawScene raw = with_mode(mode);
    CHECK(raw.meshes.empty());
    CHECK(warns(raw, "1 meshes of points or lines were left out"));
  }
  CHECK_THROWS_WITH_AS(with_mode(7), Contains("the mode 7"), InputError);
}

TEST_CASE("sparse accessors, with a base and without") {
  Gltf gltf;
  const size_t base = gltf.positions(square_corners), places = gltf.accessor<uint8_t>({2, 3}, "SCALAR", 1),
               values = gltf.positions({5, 5, 5, 0, 7, 0});
  const json sparse = {
      {"count", 2},
      {"indices", {{"bufferView", gltf.document["accessors"][places]["bufferView"]}, {"componentType", 5121}}},
      {"values", {{"bufferView", gltf.document["accessors"][values]["bufferView"]}}}};
  gltf.document["accessors"][base]["sparse"] = sparse;
  const size_t zeros =
      gltf.add("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}, {"sparse", sparse}});
  gltf.mesh({{"attributes", {{"POSITION", base}}}, {"mode", 6}}, {{"children", {1}}});
  gltf.mesh({{"attributes", {{"POSITION", zeros}}}, {"mode", 6}});
  const RawScene raw = gltf.read();
  REQUIRE(raw.meshes.size() == 2);
  CHECK(raw.meshes[0].vertices == std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {5, 5, 5}, {0, 7, 0}});
  CHECK(raw.meshes[1].vertices == std::vector<glm::dvec3>{{0, 0, 0}, {0, 0, 0}, {5, 5, 5}, {0, 7, 0}});
}

TEST_CASE("morph targets by the weights of the mesh, or of the node; skins by their joints") {
  Gltf gltf;
  json primitive = primitive_of(gltf);
  primitive["targets"] = json::array({{{"POSITION", gltf.positions({0, 0, 4, 0, 0, 4, 0, 0, 4, 0, 0, 4})}}});
  gltf.mesh(primitive, {{"children", {1}}});
  gltf.document["meshes"][0]["weights"] = {0.5};
  gltf.add("nodes", {{"mesh", 0}, {"weights", {0.25}}});
  RawScene raw = gltf.read();
  REQUIRE(raw.meshes.size() == 2);
  CHECK(raw.meshes[0].vertices.at(1) == glm::dvec3(1, 0, 2));
  CHECK(raw.meshes[1].vertices.at(1) == glm::dvec3(1, 0, 1));

  Gltf skinned;
  json body = primitive_of(skinned);
  body["attributes"]["JOINTS_0"] =
      skinned.accessor<uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, "VEC4", 4);
  body["attributes"]["WEIGHTS_0"] =
      skinned.accessor<uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 51, 204, 0, 0, 255, 0, 0, 0}, "VEC4", 4, true);
  // Its own transform is ignored.
  skinned.mesh(body, {{"skin", 0}, {"translation", {1000, 0, 0}}, {"children", {1, 2}}});
  skinned.add("nodes", {{"translation", {-1000, 0, 10}}});
  skinned.add("nodes", {{"translation", {-1000, 0, 20}}});
  const size_t inverse = skinned.accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,  //
                                                  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1},
                                                 "MAT4", 16);
  skinned.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", inverse}});
  raw = skinned.read();
  REQUIRE(raw.meshes.size() == 1);
  check_at(raw.meshes[0].vertices.at(0), {0, 0, 10});
  check_at(raw.meshes[0].vertices.at(1), {1, 0, 21});
  check_at(raw.meshes[0].vertices.at(2), {1, 1, 18.8});
}

TEST_CASE("scenes: the default one, with a word on the others; hidden nodes; animations") {
  Gltf gltf;
  for (int i = 0; i < 3; ++i) gltf.mesh(primitive_of(gltf), {{"translation", {10 * i, 0, 0}}});
  gltf.document["scenes"] = json::array({{{"nodes", {0}}}, {{"nodes", {1}}, {"name", "town"}}});
  gltf.document["scene"] = 1;
  gltf.document["animations"] = json::array({json::object()});
  RawScene raw = gltf.read();
  REQUIRE(raw.meshes.size() == 1);
  check_at(raw.meshes[0].vertices.at(0), {10, 0, 0});
  CHECK(warns(raw, "of its 2 scenes only 'town' is read"));
  CHECK(warns(raw, "2 nodes with meshes are not in the scene"));
  CHECK(warns(raw, "1 animations are not played"));
  gltf.document.erase("scene");
  check_at(gltf.read().meshes.at(0).vertices.at(0), {0, 0, 0});
  gltf.document.erase("scenes");
  CHECK(gltf.read().meshes.size() == 3);
  gltf.document["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
  raw = gltf.read();
  CHECK(raw.meshes.size() == 2);
  CHECK(warns(raw, "1 nodes are hidden"));
  gltf.document["nodes"][0]["children"] = {1};
  gltf.document["scenes"] = json::array({{{"nodes", {0, 1}}}});
  CHECK_THROWS_WITH_AS(gltf.read(), Contains("'nodes_1' is a root of its scene, and the child of another"), InputError);
}

TEST_CASE("matrices, mirrors and rotations of nodes") {
  Gltf gltf;
  gltf.mesh(primitive_of(gltf), {{"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}, {"children", {1}}});
  gltf.mesh(primitive_of(gltf), {{"scale", {-1, 1, 1}}, {"rotation", {0, 0, 2, 2}}});
  RawScene raw = gltf.read();
  REQUIRE(raw.meshes.size() == 2);
  check_at(raw.meshes[0].vertices.at(2), {3, 8, 7});
  check_at(raw.meshes[1].vertices.at(1), {7, 6, 7});
  gltf.document["nodes"][1]["rotation"] = {0, 0, 0, 0};
  CHECK_THROWS_WITH_AS(gltf.read(), Contains("the rotation of node 'nodes_1' is four zeros"), InputError);
  gltf.document["nodes"][0]["matrix"][3] = 1;
  CHECK_THROWS_WITH_AS(gltf.read(), Contains("must end in the row 0 0 0 1"), InputError);
}

TEST_CASE("buffers: data URIs, files beside the document with coded names, what is missing or short") {
  const test::TemporaryFolder folder;
  Gltf gltf;
  gltf.mesh({{"attributes", {{"POSITION", gltf.positions({0, 0, 0, 1, 0, 0, 1, 2, 0})}}}});
  const auto load = [&](const json& buffer) {
    json document = gltf.document;
    document["buffers"] = json::array({buffer});
    return read_model(folder.write("a.gltf", document.dump()), ModelFormat::gltf);
  };
  folder.write("my data.bin", gltf.data);
  std::filesystem::create_directory(folder.path() / "parts");
  folder.write("parts/a.bin", gltf.data);
  CHECK(load({{"byteLength", 36}, {"uri", "my%20data.bin"}}).meshes.at(0).vertices.at(2) == glm::dvec3(1, 2, 0));
  CHECK(load({{"byteLength", 36}, {"uri", "my data.bin"}}).files.size() == 2);
  const std::string coded = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAAEAAAAAA";
  CHECK(load({{"byteLength", 36}, {"uri", "data:application/octet-stream;base64," + coded}})
            .meshes.at(0)
            .vertices.at(2) == glm::dvec3(1, 2, 0));
  const auto fails = [&](const json& buffer, const char* message) {
    CHECK_THROWS_WITH_AS(load(buffer), Contains(message), InputError);
  };
  fails({{"byteLength", 36}, {"uri", "gone.bin"}}, "gone.bin: no such file");
  fails({{"byteLength", 36}, {"uri", "parts\\a.bin"}}, "/parts/a.bin'? write / instead of \\");
  fails({{"byteLength", 36}, {"uri", "https://example.org/a.bin"}}, "nothing is fetched");
  fails({{"byteLength", 36}, {"uri", "data:text/plain,abc"}}, "a data URI is not in base64");
  fails({{"byteLength", 36}}, "buffers[0] has no uri");
  fails({{"byteLength", 36}, {"uri", "data:;base64,AAAA"}}, "ends at byte 36 of a buffer of 3");
  gltf.document["accessors"][0]["count"] = 4;
  fails({{"byteLength", 36}, {"uri", "my%20data.bin"}}, "an accessor of 4 elements ends behind");
  gltf.document["accessors"][0].erase("bufferView");
  gltf.document["accessors"][0]["count"] = 4000000000u;
  fails({{"byteLength", 36}, {"uri", "my%20data.bin"}}, "has 4000000000 elements and no bufferView");
  gltf.document["accessors"][0] = "nonsense";
  fails({{"byteLength", 36}, {"uri", "my%20data.bin"}}, "its JSON is not what glTF 2.0 prescribes");
}
