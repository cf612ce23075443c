// SPDX-License-Identifier: Apache-2.0
// The exports of geometry: what our own loader reads back, and what they refuse. The files stay in the build folder,
// where vtk_check.py, glb_check.py and kml_check.py read them as other programs do.
#include <doctest/doctest.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <tuple>
#include "base/file.hpp"
#include "base/xml_text.hpp"
#include "convert/convert.hpp"
#include "convert/glb_file.hpp"
#include "folders.hpp"
#include "results/saved_world.hpp"
#include "scene/load.hpp"
#include "scene/volume_surface.hpp"
#include "vtk_glb_kml_run.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
namespace fs = std::filesystem;

namespace {

const fs::path folder = fs::path(test::build_folder()) / "tests/convert_geometry";
constexpr const char* projection = "+proj=tmerc +lat_0=48.137 +lon_0=11.575 +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m";

const SavedRun& run() {
  static const SavedRun saved = [] {
    fs::remove_all(folder);
    fs::create_directories(folder);
    test::write_geometry_run(folder / "run");
    return SavedRun(folder / "run");
  }();
  return saved;
}

ExportOptions options(const std::string& name) { return {folder / name, 0, run().frame_count() - 1, {}}; }

// Triangles, area and bounding box of the parts with one material.
struct Amount {
  size_t triangles = 0;
  double area_m2 = 0;
  glm::dvec3 lower{1e9}, upper{-1e9};

  void add(const std::array<glm::dvec3, 3>& p) {
    ++triangles;
    area_m2 += glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2;
    for (const glm::dvec3& v : p) lower = glm::min(lower, v), upper = glm::max(upper, v);
  }
};

void add(std::map<std::string, Amount>& amounts, const Scene& scene, const auto& position) {
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& [a, b, c] = scene.triangles[t];
    amounts[scene.materials[scene.surfaces[scene.triangle_surface[t]].material].name].add(
        {position(scene.vertices[a]), position(scene.vertices[b]), position(scene.vertices[c])});
  }
}

}  // namespace

TEST_CASE("our own loader reads a .glb back: triangles, areas, extents and materials of scene and vehicles") {
  Warnings warnings;
  const size_t row = 2;  // the lorry has been present since the row before
  ExportOptions one = options("one.glb");
  one.first_row = one.last_row = row;
  CHECK(export_glb(run(), one, warnings) == Written{one.output});
  CHECK(warnings.empty());

  const SavedWorld world = load_saved_world(run());
  std::map<std::string, Amount> expected, found;
  add(expected, world.scene, [&](const glm::dvec3& v) { return world.scene.origin_m + v; });
  const SavedFrame frame = run().frame(row);
  REQUIRE(frame.poses.size() == 2);
  for (const SavedPose& pose : frame.poses) {
    const Scene& model = world.models.at(world.instance_model[pose.instance]);
    add(expected, model, [&](const glm::dvec3& v) { return pose.position_m + pose.rotation * (model.origin_m + v); });
  }
  const Scene read = load_scene_file(one.output, {}, world.config.materials);
  add(found, read, [&](const glm::dvec3& v) { return read.origin_m + v; });
  CHECK(expected.contains("metal"));
  REQUIRE(found.size() == expected.size());
  for (const auto& [name, amount] : expected) {
    CAPTURE(name);
    REQUIRE(found.contains(name));
    CHECK(found[name].triangles == amount.triangles);
    CHECK(found[name].area_m2 == doctest::Approx(amount.area_m2).epsilon(1e-5));
    CHECK(glm::distance(found[name].lower, amount.lower) < 1e-4);  // float32 at 100 m
    CHECK(glm::distance(found[name].upper, amount.upper) < 1e-4);
  }
  for (const std::string& object : world.scene.objects) CHECK(std::ranges::count(read.objects, object) == 1);

  // Vegetation is read back as volumes, with its materials and sizes.
  REQUIRE(world.scene.volumes.size() == 3);
  REQUIRE(read.volumes.size() == 3);
  for (const Volume& volume : world.scene.volumes) {
    const bool turned = volume.yaw_rad != 0;
    const glm::dvec3 half =
        turned ? glm::dvec3(volume.half_size.y, volume.half_size.x, volume.half_size.z) : volume.half_size;
    const glm::dvec3 centre = world.scene.origin_m + volume.centre;
    CHECK(std::ranges::count_if(read.volumes, [&](const Volume& other) {
            return read.materials[other.material].name == world.scene.materials[volume.material].name &&
                   glm::distance(read.origin_m + other.centre, centre) < 1e-4 &&
                   glm::distance(other.half_size, half) < 1e-4;
          }) == 1);
  }
}

TEST_CASE("DeepMIMO's scene has no vegetation, and the export says so") {
  Warnings warnings;
  ExportOptions one = options("mimo");
  one.last_row = 0;
  export_deepmimo(run(), one, warnings);
  CHECK(std::ranges::count(warnings, "deepmimo: 3 volumes of vegetation are no objects of the scene that is written") ==
        1);
}

TEST_CASE("materials of walls have their layers in a GLB file, in their order") {
  Material wall{"facade", 3.91, 0, 0.0238, 0.16, 1, 40, 0.32};
  CHECK(glb_material(wall).at("extras").at("thickness_m") == 0.32);
  wall.layers = {{"brick", 3.91, 0, 0.0238, 0.16, 1, 40, 0.12}, {"concrete", 5.24, 0, 0.0462, 0.7822, 1, 100, 0.2}};
  const nlohmann::json extras = glb_material(wall).at("extras");
  REQUIRE(extras.at("layers").size() == 2);
  CHECK(extras.at("layers")[0].at("name") == "brick");
  CHECK(extras.at("layers")[1].at("a") == 5.24);
  CHECK(extras.at("layers")[1].at("thickness_m") == 0.2);
  CHECK_FALSE(extras.contains("a"));
}

TEST_CASE("a volume's triangles are closed, look outwards, and hold nearly all of it") {
  const double all[] = {8, 2 * std::numbers::pi, 4 * std::numbers::pi / 3};
  for (const VolumeShape shape : {VolumeShape::box, VolumeShape::cylinder, VolumeShape::spheroid}) {
    const Volume volume{.shape = shape, .centre = {50, -20, 7}, .half_size = {2, 3, 0.5}, .yaw_rad = 0.7};
    double volume_m3 = 0;
    std::map<std::array<double, 6>, int> edges;
    for (const auto& corners : surface_triangles(volume)) {
      volume_m3 +=
          glm::dot(corners[0] - volume.centre, glm::cross(corners[1] - volume.centre, corners[2] - volume.centre)) / 6;
      CHECK(glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) > 0.01);
      for (int i = 0; i < 3; ++i) {
        const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
        const bool up = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        const glm::dvec3 &p = up ? a : b, &q = up ? b : a;
        edges[{p.x, p.y, p.z, q.x, q.y, q.z}] += up ? 1 : -1;
      }
    }
    for (const auto& [edge, passes] : edges) CHECK(passes == 0);
    const double share = volume_m3 / (3 * all[static_cast<size_t>(shape)]);
    CHECK(share <= 1 + 1e-12);
    CHECK(share > (shape == VolumeShape::box ? 1 - 1e-12 : 0.92));
  }
}

TEST_CASE("files for the scripts: a drive as .glb, a folder for ParaView, a .kml with the strongest paths") {
  Warnings warnings;
  CHECK(export_glb(run(), options("drive.glb"), warnings).size() == 1);
  const Written vtk = export_vtk(run(), options("vtk"), warnings);
  CHECK(vtk.size() == 1 + 3 + 4 * test::frame_count);
  for (const fs::path& file : vtk) CHECK(fs::exists(file));
  CHECK_THROWS_AS(export_vtk(run(), options("vtk"), warnings), InputError);  // the folder exists already
  CHECK(warnings.empty());

  ExportOptions kml = options("drive.kml");
  kml.projection = projection;
  CHECK(export_kml(run(), kml, warnings).size() == 1);
  REQUIRE(warnings.size() == 1);  // 1200 - 1000
  CHECK(warnings[0].find("the 1000 strongest paths of each frame are written, 200 are left out") != std::string::npos);
}

TEST_CASE("a .kml needs to know where on the earth the scene is") {
  Warnings warnings;
  CHECK_THROWS_WITH_AS(export_kml(run(), options("nowhere.kml"), warnings), doctest::Contains("--projection"),
                       InputError);
  ExportOptions bad = options("nowhere.kml");
  bad.projection = "+proj=nonsense";
  CHECK_THROWS_AS(export_kml(run(), bad, warnings), InputError);
  CHECK(!fs::exists(bad.output));
  for (const auto& entry : fs::directory_iterator(folder)) CHECK(entry.path().extension() != ".tmp");
}

TEST_CASE("names in XML: escaped, and nothing that a parser rejects") {
  CHECK(xml_text("<a href=\"x\">&'") == "&lt;a href=&quot;x&quot;&gt;&amp;'");
  CHECK(xml_text("\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x9A\x97") == "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x9A\x97");
  CHECK(xml_text(std::string_view("\0\x01\x1F\x7F", 4)) == "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\x7F");
  CHECK(xml_text("\xFF|\xEF\xBF\xBF|\xED\xA0\x80") ==
        "\xEF\xBF\xBD|\xEF\xBF\xBD|\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // no byte of UTF-8, U+FFFF, a surrogate
}
