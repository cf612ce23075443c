// SPDX-License-Identifier: Apache-2.0
// Mitsuba XML: references, inline and nested bsdfs, parameters, transforms; errors with file, line and element.
// Each scene is one unit square, so that a transform can be read off its corners.
#include <doctest/doctest.h>

#include <algorithm>

#include "scene/mitsuba.hpp"
#include "scene_files.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using doctest::Contains;

namespace {

struct Files {
  test::TemporaryFolder folder;
  Files() { folder.write("square.ply", test::square_ply("4 0 1 2 3\n", 1)); }
  std::filesystem::path scene(const std::string& body) const {
    return folder.write("scene.xml", "<scene version=\"2.1.0\">\n" + body + "\n</scene>\n");
  }
};

std::string square(const std::string& inside, const std::string& id = "mesh-square") {
  return "<shape type=\"ply\" id=\"" + id + "\"><string value=\"square.ply\" name=\"filename\"/>" + inside + "</shape>";
}

const std::string twosided = "<bsdf type=\"twosided\" id=\"mat-itu_brick\"><bsdf type=\"diffuse\" id=\"x\"/></bsdf>";
const std::string brick = "<ref name=\"bsdf\" id=\"mat-itu_brick\"/>";

glm::dvec3 corner_after(const std::string& operations) {  // returns the image of (1, 1, 0)
  const Files files;
  const RawScene raw = read_mitsuba(
      files.scene(twosided + square(brick + "<transform name=\"to_world\">" + operations + "</transform>")));
  return raw.meshes.at(0).vertices.at(2);
}

void check_near(glm::dvec3 p, glm::dvec3 q) {
  for (int k = 0; k < 3; ++k) CHECK(p[k] == doctest::Approx(q[k]).epsilon(1e-14));
}

Material only_material(const std::string& body) {
  const Files files;
  const Scene scene = load_scene_file(files.scene(body), {});
  REQUIRE(scene.materials.size() == 1);
  return scene.materials[0];
}

}  // namespace

TEST_CASE("only the outermost id of a holder counts, before or after its use") {
  CHECK(only_material(twosided + square(brick)).name == "brick");
  CHECK(only_material(square(brick) + twosided).a == 3.91);
  CHECK(only_material("<bsdf id=\"itu_wood\" type=\"diffuse\"/>" + square("<ref id=\"itu_wood\"/>")).name == "wood");
}

TEST_CASE("radio materials of Sionna RT") {
  const Material itu = only_material(
      "<bsdf type=\"itu-radio-material\" id=\"facade\"><float name=\"thickness\" value=\"1.\"/>"
      "<string name=\"type\" value=\"glass\"/></bsdf>" +
      square("<ref name=\"bsdf\" id=\"facade\"/>"));
  CHECK(itu.name == "facade");
  CHECK(itu.a == 6.31);
  CHECK(itu.thickness_m == 1);
  const Material own = only_material(
      square("<bsdf type=\"twosided\" id=\"mat-snow\"><bsdf type=\"radio-material\"><float "
             "name=\"relative_permittivity\" value=\"1.5\"/>"
             "<float name=\"conductivity\" value=\"2e-4\"/><float name=\"thickness\" value=\"0.3\"/></bsdf></bsdf>"));
  CHECK(own == Material{.name = "snow", .a = 1.5, .c = 2e-4, .thickness_m = 0.3});
  const Material inline_itu =
      only_material(square("<bsdf type=\"itu-radio-material\"><string name=\"type\" value=\"metal\"/></bsdf>"));
  CHECK(inline_itu.name == "metal");
  CHECK(inline_itu.thickness_m == 0.1);
}

TEST_CASE("parameters") {
  CHECK(only_material("<default name=\"t\" value=\"9\"/><default name=\"thick\" value=\"0.25\"/>"
                      "<bsdf type=\"itu-radio-material\" id=\"m\"><string name=\"type\" value=\"wood\"/>"
                      "<float name=\"thickness\" value=\"$thick\"/></bsdf>" +
                      square("<ref id=\"m\"/>"))
            .thickness_m == 0.25);
}

TEST_CASE("transforms compose in the order of the file") {
  check_near(corner_after("<translate x=\"1\" z=\"2\"/>"), {2, 1, 2});
  check_near(corner_after("<translate value=\"1 0 2\"/><scale value=\"2\"/>"), {4, 2, 4});
  check_near(corner_after("<scale value=\"2, 3, 4\"/><translate value=\"1 0 2\"/>"), {3, 3, 2});
  check_near(corner_after("<scale y=\"-1\"/>"), {1, -1, 0});
  check_near(corner_after("<rotate z=\"1\" angle=\"90\"/>"), {-1, 1, 0});
  check_near(corner_after("<rotate value=\"1 0 0\" angle=\"90\"/><rotate z=\"2\" angle=\"90\"/>"), {0, 1, 1});
  check_near(corner_after("<matrix value=\"0 2 0 5  1 0 0 6  0 0 1 7  0 0 0 1\"/>"), {7, 7, 7});
  check_near(corner_after("<matrix value=\"0 2 0 1 0 0 0 0 1\"/>"), {2, 1, 0});
}

TEST_CASE("what is no geometry is skipped; what is unknown is a warning") {
  const Files files;
  const RawScene raw = read_mitsuba(
      files.scene("<integrator type=\"path\"/><sensor type=\"perspective\"><float name=\"f\" value=\"$x\"/>"
                  "</sensor><emitter type=\"constant\"/><!-- a comment --><volume/>\n" +
                  twosided + square(brick)));
  CHECK(raw.meshes.size() == 1);
  CHECK(raw.meshes[0].name == "square");
  REQUIRE(raw.warnings.size() == 1);
  CHECK(raw.warnings[0].find("scene.xml:2: <volume>") != std::string::npos);
}

TEST_CASE("a shape is read as its type says, whatever the suffix of its file") {
  const Files files;
  for (const char* name : {"a.obj", "a.mesh", "a.glb", "a.ply", "a"}) {
    CAPTURE(name);
    files.folder.write(name, "# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    const RawScene raw = read_mitsuba(
        files.scene("<shape type=\"obj\"><string name=\"filename\" value=\"" + std::string(name) + "\"/></shape>"));
    REQUIRE(raw.meshes.size() == 1);
    CHECK(raw.meshes[0].triangles.size() == 2);
    CHECK(raw.meshes[0].where.ends_with(name));
  }
}

TEST_CASE("files of Mitsuba before 2.0: names in camelCase are read as their new names") {
  const Files files;
  const auto corner = [&](const std::string& version, const std::string& transform) {
    const RawScene raw = read_mitsuba(files.folder.write(
        "old.xml", "<scene version=\"" + version + "\">" + twosided + square(brick + transform) + "</scene>"));
    return raw.meshes.at(0).vertices.at(2);
  };
  const std::string lifted = "<transform name=\"toWorld\"><translate z=\"3\"/></transform>",
                    flags =
                        "<boolean name=\"faceNormals\" value=\"true\"/><float name=\"maxSmoothAngle\" value=\"3\"/>";
  check_near(corner("0.6.0", lifted + flags), {1, 1, 3});
  check_near(corner("1.9", lifted), {1, 1, 3});
  check_near(
      corner("0.5", "<transform name=\"toWorld\"><lookAt origin=\"0 0 5\" target=\"0 1 5\" up=\"0 0 1\"/></transform>"),
      {-1, 0, 6});
  for (const char* version : {"2.0.0", "3.5.2", "3"})
    CHECK_THROWS_WITH_AS(corner(version, lifted), Contains("has no property 'toWorld'; did you mean \"to_world\"?"),
                         InputError);
  CHECK_THROWS_WITH_AS(corner("3.0.0", lifted), Contains("begins with <scene version=\"0.6.0\">"), InputError);
  CHECK_THROWS_WITH_AS(corner("new", ""), Contains("version=\"new\" is no version"), InputError);
}

TEST_CASE("lookat, as a camera has its axes") {
  check_near(corner_after("<lookat origin=\"1 2 3\" target=\"1 2 9\" up=\"0 1 0\"/>"), {2, 3, 3});
  check_near(corner_after("<lookat origin=\"0 0 0\" target=\"4 0 0\" up=\"0 0 1\"/>"), {0, 1, 1});
}

TEST_CASE("rectangles, cubes, merged shapes, groups and their instances") {
  const Files files;
  const auto moved = [](int x) {
    return "<transform name=\"to_world\"><translate x=\"" + std::to_string(x) + "\"/></transform>";
  };
  const RawScene raw = read_mitsuba(
      files.scene(twosided + "<shape type=\"rectangle\"><boolean name=\"flip_normals\" value=\"true\"/>" + brick +
                  "</shape>" + "<shape type=\"instance\"><ref id=\"group\"/>" + moved(50) + "</shape>" +
                  "<shape type=\"shapegroup\" id=\"group\">" + "<shape type=\"cube\" id=\"box\">" + brick + moved(5) +
                  "</shape>" + square(brick) + "</shape>" + "<shape type=\"instance\"><ref id=\"group\"/>" + moved(90) +
                  "</shape>" + "<shape type=\"merge\">" + square(brick, "a") + square(brick, "b") + "</shape>"));
  REQUIRE(raw.meshes.size() == 7);
  CHECK(raw.meshes[0].name == "rectangle");
  CHECK(raw.meshes[0].vertices.at(0) == glm::dvec3(-1, -1, 0));
  CHECK(raw.meshes[1].name == "box");
  CHECK(raw.meshes[1].triangles.size() == 12);
  CHECK(raw.meshes[1].vertices.at(7) == glm::dvec3(56, 1, 1));
  CHECK(raw.meshes[2].vertices.at(2) == glm::dvec3(51, 1, 0));
  CHECK(raw.meshes[3].vertices.at(0) == glm::dvec3(94, -1, -1));
  CHECK(raw.meshes[5].name == "a");
  CHECK(raw.meshes[6].name == "b");
  for (const RawMesh& mesh : raw.meshes) CHECK(raw.materials.at(mesh.material).name == "mat-itu_brick");
  SceneConfig config;
  CHECK(
      load_scene_file(files.scene(twosided + "<shape type=\"cube\">" + brick + "</shape>"), config).report.free_edges ==
      0);
}

TEST_CASE("included files, aliases, search paths, several parameters in one value") {
  const Files files;
  std::filesystem::create_directories(files.folder.path() / "parts/meshes");
  files.folder.write("parts/meshes/far.ply", test::square_ply("4 0 1 2 3\n", 1));
  files.folder.write("parts/more.xml",
                     "<scene version=\"0.6.0\">\n<shape type=\"ply\"><string name=\"filename\" "
                     "value=\"$dir/$file\"/><ref id=\"other name\" name=\"any\"/>"
                     "<transform name=\"toWorld\"><scale value=\"2\"/></transform></shape></scene>");
  files.folder.write("one.xml", "<shape type=\"rectangle\" id=\"alone\">" + brick + "</shape>");
  const RawScene raw = read_mitsuba(
      files.scene("<default name=\"dir\" value=\"meshes\"/><default name=\"dir\" value=\"elsewhere\"/>"
                  "<default name=\"file\" value=\"far.ply\"/><alias id=\"mat-itu_brick\" as=\"other name\"/>"
                  "<include filename=\"parts/more.xml\"/><include filename=\"one.xml\"/>" +
                  twosided));
  REQUIRE(raw.meshes.size() == 2);
  CHECK(raw.meshes[0].name == "far");
  CHECK(raw.meshes[0].vertices.at(2) == glm::dvec3(2, 2, 0));
  CHECK(raw.materials.at(raw.meshes[0].material).name == "mat-itu_brick");
  CHECK(raw.meshes[1].name == "alone");
  CHECK(raw.files.size() == 4);
  const RawScene found =
      read_mitsuba(files.scene("<path value=\"parts/meshes\"/><shape type=\"ply\"><string "
                               "name=\"filename\" value=\"far.ply\"/></shape>"));
  CHECK(found.meshes.size() == 1);
  files.folder.write("parts/bad.xml", "<scene version=\"3.0.0\">\n\n<shape type=\"sphere\"/></scene>");
  CHECK_THROWS_WITH_AS(read_mitsuba(files.scene("<include filename=\"parts/bad.xml\"/>")),
                       Contains("parts/bad.xml:3: <shape type=\"sphere\">"), InputError);
}

TEST_CASE("what a Mitsuba file says and this program does not know is refused by name") {
  const Files files;
  const auto fails = [&](const std::string& body, const char* message) {
    CAPTURE(message);
    CHECK_THROWS_WITH_AS(read_mitsuba(files.scene("\n" + body)), Contains(message), InputError);
  };
  fails("<Shape type=\"ply\"/>", "scene.xml:3: <Shape type=\"ply\">: Mitsuba has no such element");
  fails(square(brick + "<transform name=\"to_wrld\"/>"), "has no property 'to_wrld'; did you mean \"to_world\"?");
  fails(twosided + square(brick + "<float name=\"scale\" value=\"2\"/>"), "has no property 'scale'; known: filename");
  fails(twosided + square(brick + "<translate x=\"3\"/>"), "<translate> is not known inside of <shape type=\"ply\"");
  fails(twosided + square(brick + "<float name=\"to_world\" value=\"2\"/>"),
        "to_world of <shape type=\"ply\" id=\"mesh-square\"> must be a <transform>");
  fails(twosided + square(brick + brick), "is a second material");
  fails(twosided + square(brick + "<string name=\"filename\" value=\"b.ply\"/>"), "has the property 'filename' twice");
  fails("<shape type=\"ply\" to_world=\"1\"/>", "has the attribute to_world, which is not known here");
  fails(twosided + twosided, "another <bsdf> of this file has this id");
  fails("<bsdf type=\"radio-material\" id=\"m\"><float name=\"permittivity\" value=\"5\"/></bsdf>",
        "has no property 'permittivity'");
  fails("<bsdf type=\"radio-material\" id=\"m\"><string name=\"thickness\" value=\"5\"/></bsdf>",
        "thickness of <bsdf type=\"radio-material\" id=\"m\"> must be a <float> or <integer>");
  fails("<shape type=\"instance\"><ref id=\"none\"/></shape>",
        "needs one <ref id=\"...\"/> to a shape of type shapegroup");
  fails("<alias id=\"a\" as=\"b\"/>", "names nothing that this file defines");
  fails("<shape type=\"ply\"><string name=\"filename\" value=\"parts\\square.ply\"/></shape>",
        "write / instead of \\ between");
  std::filesystem::create_directory(files.folder.path() / "here");
  files.folder.write("here/square.ply", "");
  fails("<shape type=\"ply\"><string name=\"filename\" value=\"here\\square.ply\"/></shape>",
        "/here/square.ply'? write /");
}

TEST_CASE("a bsdf of an unknown type counts by its id, with a word") {
  const Files files;
  const RawScene raw = read_mitsuba(
      files.scene("<bsdf type=\"my-material\" id=\"mat-itu_brick\"><float name=\"thickness\" value=\"3\"/></bsdf>" +
                  square(brick)));
  REQUIRE(raw.warnings.size() == 1);
  CHECK(raw.warnings[0].find("this type of bsdf is not known") != std::string::npos);
}

TEST_CASE("Mitsuba errors name file, line and element") {
  const Files files;
  const auto fails = [&](const std::string& body, const char* message) {
    CAPTURE(message);
    const std::filesystem::path path = files.scene("\n" + body);
    CHECK_THROWS_WITH_AS(load_scene_file(path, {}), Contains(message), InputError);
    CHECK_THROWS_WITH_AS(load_scene_file(path, {}), Contains(files.folder.path().c_str()), InputError);
  };
  fails("\n<shape type=\"sphere\" id=\"ball\"/>",
        "scene.xml:4: <shape type=\"sphere\" id=\"ball\">: shapes of this type");
  fails("<shape type=\"ply\" id=\"a\"/>", "scene.xml:3: <shape type=\"ply\" id=\"a\"> needs <string name=\"filename\"");
  fails("<shape type=\"ply\"><string name=\"filename\" value=\"gone.ply\"/></shape>", "there is no file");
  fails("<shape type=\"ply\"><string name=\"filename\" value=\"" + std::string(300, 'x') + "\"/></shape>",
        "there is no file");  // a longer name than any file can have
  fails("<shape type=\"obj\"><string name=\"filename\" value=\"/\"/></shape>", "is a folder");
  fails("<shape type=\"ply\"><string name=\"filename\" value=\"/\"/></shape>", "is a folder");
  fails(square("<ref name=\"bsdf\" id=\"nothing\"/>"), "refers to the material 'nothing', but no <bsdf>");
  fails(square(""), "mesh 'square' has no material; set scene.default_material");
  fails("<bsdf type=\"diffuse\" id=\"mat-Facade\"/>" + square("<ref id=\"mat-Facade\"/>"),
        "square.ply: mesh 'square': the material 'mat-Facade' is not known; known ITU materials: vacuum, concrete");
  fails("<bsdf type=\"diffuse\" id=\"Facade\"/>" + square("<ref id=\"Facade\"/>"),
        "[scene.material_alias]\n  \"Facade\" = ");
  fails("<bsdf type=\"itu-radio-material\" id=\"m\"/>",
        "scene.xml:3: <bsdf type=\"itu-radio-material\" id=\"m\"> needs");
  fails("<bsdf type=\"itu-radio-material\" id=\"m\"><string name=\"type\" value=\"cheese\"/></bsdf>" +
            square("<ref id=\"m\"/>"),
        "material 'm' has the ITU type 'cheese'");
  fails("<bsdf type=\"radio-material\" id=\"m\"><float name=\"relative_permittivity\" value=\"0.5\"/></bsdf>",
        "relative_permittivity = '0.5' must be a number of at least 1");
  fails("<bsdf type=\"radio-material\" id=\"m\"><float name=\"thickness\" value=\"0\"/></bsdf>", "thickness = '0'");
  for (const std::string blanks : {"", " ", "   \t "})
    fails("<bsdf type=\"radio-material\" id=\"m\"><float name=\"thickness\" value=\"" + blanks + "\"/></bsdf>",
          "thickness = '");
  fails("<bsdf type=\"radio-material\" id=\"m\"><float name=\"thickness\" value=\"$t\"/></bsdf>",
        "'$t' has no <default>");
  fails("<include filename=\"other.xml\"/>", "<include>: there is no file");
  fails("<include filename=\"scene.xml\"/>", "scene.xml includes itself");
  const auto transform = [](const std::string& op) {
    return twosided + square(brick + "<transform name=\"to_world\">" + op + "</transform>");
  };
  fails(transform("<lookat origin=\"0 0 0\"/>"), "<lookat> of a transform needs three numbers in each of origin");
  fails(transform("<look_at origin=\"0 0 0\"/>"), "<look_at> of a transform is not supported");
  fails(transform("<rotate z=\"1\" ang=\"90\"/>"), "<rotate> has the attribute ang, which is not known here");
  fails(transform("<translate X=\"3\"/>"), "<translate> has the attribute X");
  fails(transform("<translate value=\"1 2 3\" z=\"3\"/>"), "has a value beside x, y or z");
  fails(transform("<matrix value=\"1 2 3\"/>"), "needs 16 numbers");
  fails(transform("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/>"), "row 0 0 0 1");
  fails(transform("<rotate angle=\"3\"/>"), "needs an axis");
  fails(transform("<scale value=\"1 2\"/>"), "one or three numbers");
  fails(transform("<scale value=\"0\"/>"), "a factor is zero");
  fails(transform("<translate x=\"far\"/>"), "bad number in x=\"far\"");
  fails("<shape type=\"ply\">", "not well-formed XML");
  const auto osm = files.folder.write("map.osm", "\n<osm version=\"0.6\"/>");
  CHECK_THROWS_WITH_AS(load_scene_file(osm, {}), Contains("map.osm:2: the root element is <osm>"), InputError);
}
