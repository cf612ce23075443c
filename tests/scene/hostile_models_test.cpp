// SPDX-License-Identifier: Apache-2.0
// Short files that need much work or memory: names that repeat, groups of groups, parameters of parameters, copies of
// copies.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "gltf_builder.hpp"
#include "scene/mitsuba.hpp"
#include "scene/model.hpp"
#include "scene_files.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;

namespace {

// Counts how often a file is opened from now on.
class OpeningCount {
 public:
  explicit OpeningCount(const std::filesystem::path& path) : descriptor_(inotify_init1(IN_NONBLOCK)) {
    // Equal events in a row are merged: so each opening is separated from the next one by a closing.
    REQUIRE(inotify_add_watch(descriptor_, path.c_str(), IN_OPEN | IN_CLOSE) >= 0);
  }
  ~OpeningCount() { close(descriptor_); }
  OpeningCount(const OpeningCount&) = delete;
  OpeningCount& operator=(const OpeningCount&) = delete;

  size_t count() {
    alignas(inotify_event) std::array<char, 4096> buffer{};
    for (ssize_t size = 0; (size = read(descriptor_, buffer.data(), buffer.size())) > 0;)
      for (size_t at = 0; at < static_cast<size_t>(size);) {
        inotify_event event{};
        std::memcpy(&event, buffer.data() + at, sizeof event);
        count_ += (event.mask & IN_OPEN) != 0;
        at += sizeof event + event.len;
      }
    return count_;
  }

 private:
  int descriptor_;
  size_t count_ = 0;
};

std::string repeated(const std::string& text, size_t count) {
  std::string out;
  for (size_t i = 0; i < count; ++i) out += text;
  return out;
}

std::string scene_of(const std::string& body) { return "<scene version=\"3.0.0\">\n" + body + "</scene>\n"; }

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("OBJ: libraries of materials are not read, and faces have the materials that they name") {
  const test::TemporaryFolder folder;
  const std::filesystem::path library = folder.write("many.mtl", "map_Pm brick.png\nnewmtl brick\nnewmtl glass\n");
  const std::filesystem::path model = folder.write(
      "many.obj", triangle + repeated("mtllib many.mtl\n", 1000) + "usemtl glass\nf 1 2 3\nusemtl slate\nf 3 2 1\n");
  OpeningCount openings(library);
  const RawScene raw = read_model(model, ModelFormat::obj);
  CHECK(openings.count() == 0);
  CHECK(raw.files == std::vector<std::string>{model.string()});
  REQUIRE(raw.meshes.size() == 2);
  CHECK(raw.materials.at(raw.meshes[0].material).name == "glass");
  CHECK(raw.materials.at(raw.meshes[1].material).name == "slate");
}

TEST_CASE("Mitsuba: a mesh that a hundred shapes name is read twice, each shape has it, and its warnings come once") {
  const test::TemporaryFolder folder;
  const std::string body = triangle + "f 1 2 3\nl 1 2\n";
  for (const auto& [type, text] :
       {std::pair<std::string, std::string>{"obj", body}, {"ply", test::square_ply("4 0 1 2 3\n", 1)}}) {
    CAPTURE(type);
    const std::filesystem::path mesh = folder.write("part." + type, text);
    std::string shapes;
    for (int x = 0; x < 100; ++x)
      shapes += fmt::format(R"(<shape type="{0}" id="part_{1}"><string name="filename" value="part.{0}"/>)"
                            R"(<transform name="to_world"><translate x="{1}"/></transform></shape>)",
                            type, x);
    OpeningCount openings(mesh);
    const RawScene raw = read_mitsuba(folder.write("scene.xml", scene_of(shapes)));
    CHECK(openings.count() >= 1);
    CHECK(openings.count() < 20);
    REQUIRE(raw.meshes.size() == 100);
    for (int x = 0; x < 100; ++x) {
      CHECK(raw.meshes[x].vertices.at(1).x == x + 1);
      CHECK(raw.meshes[x].name == fmt::format("part_{}", x));
      CHECK(raw.meshes[x].where == mesh.string());
    }
    size_t warnings = 0;
    for (const std::string& warning : raw.warnings) warnings += warning.find("lines and points") != std::string::npos;
    CHECK(warnings == (type == "obj" ? 1 : 0));
  }
}

TEST_CASE("Mitsuba: parameters of parameters and groups of instances end, as long as the file is short") {
  const test::TemporaryFolder folder;
  std::string parameters = "<default name=\"a\" value=\"xx\"/>\n", groups, more;
  for (char c = 'b'; c <= 'k'; ++c)
    parameters += fmt::format("<default name=\"{}\" value=\"{}\"/>\n", c, repeated({'$', static_cast<char>(c - 1)}, 4));
  CHECK_THROWS_WITH_AS(read_mitsuba(folder.write("p.xml", scene_of(parameters))),
                       Contains("p.xml:10: <default>: value is longer than 65536 characters"), InputError);
  groups = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\"/></shape>\n";
  more =
      "<shape type=\"shapegroup\" id=\"h\"><shape type=\"merge\">\n<shape type=\"instance\"><ref id=\"g\"/></shape>"
      "</shape></shape>\n";
  CHECK_THROWS_WITH_AS(read_mitsuba(folder.write("g.xml", scene_of(groups + more))),
                       Contains("g.xml:4: <shape type=\"instance\">: an instance must not be part of a shapegroup"),
                       InputError);
}

TEST_CASE("glTF: copies of a mesh end where they are too many; the same number of places for one vertex does not") {
  for (const bool many : {true, false}) {
    test::Gltf gltf;
    const size_t corners =
        gltf.add("accessors", {{"componentType", 5126}, {"count", many ? 4095 : 3}, {"type", "VEC3"}});
    const size_t places = gltf.add("accessors", {{"componentType", 5126}, {"count", 4096}, {"type", "VEC3"}});
    const nlohmann::json attributes = {{"TRANSLATION", places}};
    gltf.mesh({{"attributes", {{"POSITION", corners}}}},
              {{"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    for (int k = 0; many && k < 4; ++k) gltf.document["nodes"].push_back(gltf.document["nodes"][0]);
    gltf.document["scenes"][0]["nodes"] = nlohmann::json::array();
    for (size_t k = 0; k < gltf.document["nodes"].size(); ++k) gltf.document["scenes"][0]["nodes"].push_back(k);
    if (many)
      CHECK_THROWS_WITH_AS(gltf.read(), Contains("have more than 50000000 vertices"), InputError);
    else
      CHECK(gltf.read().meshes.size() == 4096);
  }
}

TEST_CASE("OBJ: a file that is its own library of materials is not read as one") {
  const test::TemporaryFolder folder;
  for (const char* name : {"own.obj", "own"}) {
    const std::filesystem::path file =
        folder.write(name, triangle + "f 1 2 3\nmtllib own\nmtllib own.obj\nmap_Pm a.png\nnewmtl b\nmap_Pm c.png\n");
    const RawScene raw = read_model(file, ModelFormat::obj);
    REQUIRE(raw.meshes.size() == 1);
    CHECK(raw.meshes[0].triangles.size() == 1);
    CHECK(raw.files == std::vector<std::string>{file.string()});
  }
}

TEST_CASE("OBJ: blanks and slashes that assimp cannot read are refused with their line") {
  const test::TemporaryFolder folder;
  for (const std::string line :
       {"f 1 2 3\v", "f 1 2 3 \v\t\v", "f\f1 2 3", "v 0 0\v0", "mtllib a//b.mtl", "mtllib a\\\\b"}) {
    CAPTURE(line);
    const std::filesystem::path file = folder.write("a.obj", triangle + line);
    CHECK_THROWS_WITH_AS(read_model(file, ModelFormat::obj), Contains("a.obj:4: "), InputError);
  }
  CHECK(read_model(folder.write("a.obj", triangle + "mtllib a/b.mtl\n# a // \v\nf 1 2 3\r\n"), ModelFormat::obj)
            .meshes.size() == 1);
}

TEST_CASE("glTF: numbers that should be whole and small are refused with their names where they are not") {
  const auto refused = [](const auto& change, const char* message) {
    test::Gltf gltf;
    gltf.mesh({{"attributes", {{"POSITION", gltf.positions({0, 0, 0, 1, 0, 0, 1, 2, 0})}}}});
    change(gltf.document);
    CAPTURE(message);
    CHECK_THROWS_WITH_AS(gltf.read(), Contains(message), InputError);
  };
  using nlohmann::json;
  for (const double number : {1e122, -1e122, 2.5}) {
    const std::string is = "\" is " + json(number).dump() + ", but must be a whole number from ";
    const auto member = [&](const char* list, const char* key) {
      refused([&](json& d) { d[list][0][key] = number; }, fmt::format("{}[0]: \"{}{}", list, key, is).c_str());
    };
    refused([&](json& d) { d["scene"] = number; }, ("\"scene" + is).c_str());
    for (const char* key : {"count", "componentType"}) member("accessors", key);
    for (const char* key : {"byteOffset", "byteLength", "byteStride"}) member("bufferViews", key);
    refused([&](json& d) { d["accessors"][0]["byteOffset"] = number; }, ("an accessor: \"byteOffset" + is).c_str());
    refused([&](json& d) { d["meshes"][0]["primitives"][0]["mode"] = number; }, ("a mesh: \"mode" + is).c_str());
    refused(
        [&](json& d) {
          d["accessors"][0]["sparse"] = {{"count", number}, {"indices", {}}, {"values", {}}};
        },
        ("a sparse accessor: \"count" + is).c_str());
  }
  refused([](json& d) { d["scene"] = -1; }, "\"scene\" is -1, but must be a whole number from 0 to ");
  refused([](json& d) { d["scene"] = "0"; }, "\"scene\" is of the type string, but must be a whole number");
  test::Gltf whole;
  whole.mesh({{"attributes", {{"POSITION", whole.positions({0, 0, 0, 1, 0, 0, 1, 2, 0})}}}});
  whole.document["accessors"][0]["count"] = 3.0;
  CHECK(whole.read().meshes.size() == 1);
}

TEST_CASE("glTF: elements without data are as few as the file is short") {
  test::Gltf gltf;
  const size_t corners = gltf.add("accessors", {{"componentType", 5126}, {"count", 5000}, {"type", "VEC3"}});
  gltf.mesh({{"attributes", {{"POSITION", corners}}}});
  CHECK_THROWS_WITH_AS(gltf.read(), Contains("has 5000 elements and no bufferView"), InputError);
}
