// SPDX-License-Identifier: Apache-2.0
// Tests volumes of vegetation: meshes that contain faces several times, and volumes that are listed several times. By
// the divergence theorem, every mesh must enclose the same volume as the plain box.
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/volume_overlaps.hpp"
#include "scene/volumes.hpp"
#include "scene_files.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

namespace {

RawMesh box_of_leaves(glm::dvec3 low, glm::dvec3 high) {
  RawMesh mesh{"crown", "crown.ply", {}, {}, 0};
  for (uint32_t i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  for (const auto& [a, b, c, d] : std::vector<std::array<uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

RawMesh joined(RawMesh a, const RawMesh& b) {
  const auto first = static_cast<uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

RawMesh turned(RawMesh mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

double cubic_metres(const std::vector<Volume>& volumes) {
  double six = 0;
  for (const Volume& volume : volumes)
    for (const auto& [a, b, c] : volume.triangles) six += glm::dot(a, glm::cross(b, c));
  return six / 6;
}

struct Enclosed {
  double m3;
  uint64_t repeated;
};

Enclosed enclosed(const RawMesh& mesh) {
  LoadReport report;
  const double m3 = cubic_metres(mesh_volumes(mesh, 0, &report));
  return {m3, report.duplicate_triangles};
}

Volume shaped(VolumeShape shape, glm::dvec3 centre, glm::dvec3 half, double yaw_rad = 0, uint32_t material = 0) {
  Volume out;
  out.shape = shape;
  out.centre = centre;
  out.half_size = half;
  out.yaw_rad = yaw_rad;
  out.material = material;
  return out;
}

}  // namespace

TEST_CASE("a crown whose faces are in the file twice, both ways, in part, or three times is one crown") {
  const RawMesh box = box_of_leaves({8, -5, 0}, {12, 5, 8});
  CHECK(enclosed(box).m3 == doctest::Approx(320));
  CHECK(enclosed(box).repeated == 0);
  CHECK(enclosed(turned(box)).m3 == doctest::Approx(320));
  RawMesh partly = box;
  for (size_t t = 0; t < 5; ++t) partly.triangles.push_back(turned(box).triangles[t]);
  partly.triangles.push_back(box.triangles[7]);
  for (const auto& [mesh, repeated] :
       std::vector<std::pair<RawMesh, uint64_t>>{{joined(box, box), 12},
                                                 {joined(box, turned(box)), 12},
                                                 {joined(turned(box), joined(box, box)), 24},
                                                 {partly, 6}}) {
    CHECK(enclosed(mesh).m3 == doctest::Approx(320));
    CHECK(enclosed(mesh).repeated == repeated);
    CHECK(mesh_volumes(mesh, 0).size() == 1);
  }
  RawMesh open = joined(box, box);
  open.triangles.erase(open.triangles.begin() + 12);
  open.triangles.erase(open.triangles.begin());
  CHECK_THROWS_AS(mesh_volumes(open, 0), InputError);  // both copies of one triangle are missing
}

TEST_CASE("crowns that touch, in one mesh: the wall between them is no outside, once or twice") {
  const RawMesh left = box_of_leaves({0, 0, 0}, {2, 2, 2}), right = box_of_leaves({2, 0, 0}, {5, 2, 2});
  const RawMesh both = joined(left, right);
  CHECK(enclosed(both).m3 == doctest::Approx(20));
  CHECK(enclosed(both).repeated == 0);  // the same as it was read before
  CHECK(enclosed(joined(both, both)).m3 == doctest::Approx(20));
  CHECK(enclosed(joined(both, turned(both))).m3 == doctest::Approx(20));
  const RawMesh apart = joined(left, box_of_leaves({3, 0, 0}, {4, 2, 2}));
  CHECK(enclosed(joined(apart, turned(left))).m3 ==
        doctest::Approx(12));  // one of two parts is there in both orientations
}

TEST_CASE("boxes that meet: those before, and not those that touch") {
  const std::vector<Volume> volumes = {
      shaped(VolumeShape::box, {0, 0, 0}, {1, 1, 1}), shaped(VolumeShape::box, {2, 0, 0}, {1, 1, 1}),
      shaped(VolumeShape::spheroid, {1, 0, 0}, {1, 1, 1}), shaped(VolumeShape::box, {0, 0, 3}, {9, 9, 1}),
      shaped(VolumeShape::box, {3.2, 1.2, 0}, {0.5, 0.1, 1}, 1.5707963267948966)};
  CHECK(earlier_volumes(volumes) == std::vector<std::vector<uint32_t>>{{}, {}, {0, 1}, {}, {}});
}

TEST_CASE("volumes that are there twice are kept once, with a count; those of two materials get a word") {
  std::vector<Volume> volumes;
  std::vector<std::string> warnings;
  const Volume box = shaped(VolumeShape::box, {0, 0, 0}, {1, 2, 1}, 0.3),
               ball = shaped(VolumeShape::spheroid, {9, 0, 0}, {1, 1, 1});
  volumes = {box, ball, box, ball, ball};
  volumes[2].yaw_rad += 3.141592653589793;  // the same box
  volumes[3].yaw_rad = 1;                   // the same ball
  settle_overlaps(volumes, warnings);
  CHECK(volumes.size() == 2);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].starts_with("3 volumes of vegetation repeat another one"));
  volumes = {box, box};
  volumes[1].yaw_rad += 0.1;
  volumes[1].material = 1;
  settle_overlaps(volumes, warnings);
  CHECK(volumes.size() == 2);
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[1].starts_with("1 volumes of vegetation reach into the boxes of others of a different material"));
}

TEST_CASE("a crown that is two objects of a scene is one volume; doubled faces are counted") {
  const test::TemporaryFolder folder;
  folder.write("crown.ply", test::box_ply({8, -5, 0}, {12, 5, 8}));
  folder.write("ground.ply", test::square_ply("4 0 1 2 3\n", 1));
  const auto shape = [](const char* file, const char* material) {
    return std::string("<shape type=\"ply\"><string name=\"filename\" value=\"") + file + "\"/><ref id=\"" + material +
           "\"/></shape>";
  };
  const std::string crown = shape("crown.ply", "vegetation");
  const Scene scene = load_scene_file(
      folder.write("scene.xml",
                   "<scene version=\"3.0.0\"><bsdf type=\"diffuse\" id=\"itu_concrete\"/><bsdf type=\"diffuse\" "
                   "id=\"vegetation\"/>" +
                       shape("ground.ply", "itu_concrete") + crown + crown + "</scene>"),
      {});
  CHECK(scene.volumes.size() == 1);
  REQUIRE(!scene.report.warnings.empty());
  CHECK(scene.report.warnings.back().starts_with("1 volumes of vegetation repeat another one"));
}
