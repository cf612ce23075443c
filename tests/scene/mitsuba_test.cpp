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

glm::dvec3 corner_after(const std::string& operations) {  // where (1, 1, 0) goes
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
  fails("<include filename=\"other.xml\"/>", "<include> is not supported");
  const auto transform = [](const std::string& op) {
    return twosided + square(brick + "<transform name=\"to_world\">" + op + "</transform>");
  };
  fails(transform("<lookat origin=\"0 0 0\"/>"), "<lookat> of a transform is not supported");
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
