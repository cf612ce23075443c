// SPDX-License-Identifier: Apache-2.0
// vegetation: lengths of random paths in random volumes, by the tree, against all volumes one by one in double.
#include "passes/vegetation.hpp"

#include <doctest/doctest.h>

#include "passes/solved_rows.hpp"
#include "passes/triangles.hpp"
#include "scene/volumes.hpp"
#include "wavetracer/device/volumes.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A pyramid with its tip down or up, closed.
RawMesh pyramid(const glm::dvec3& tip, double height, double side) {
  RawMesh mesh{"crown", "crown.ply", {tip}, {{1, 3, 2}, {1, 4, 3}}, 0};
  for (const auto& [x, y] : std::vector<std::array<double, 2>>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    mesh.vertices.push_back(tip + glm::dvec3(x * side, y * side, -height));
  for (uint32_t i = 0; i < 4; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 4});
  return mesh;
}

// The volumes have three materials.
VolumeTable random_volumes(Random& random, uint32_t count) {
  Scene scene;
  const auto place = [&] {
    return glm::dvec3(random.between(-50, 50), random.between(-50, 50), random.between(0, 20));
  };
  for (uint32_t i = 0; i < count; ++i) {
    Volume volume;
    if (i % 4 == 3) {
      volume = mesh_volumes(pyramid(place(), random.between(-8, 8), random.between(1, 5)), 0).at(0);
    } else {
      volume.shape = static_cast<VolumeShape>(i % 4);
      volume.centre = place();
      volume.half_size = {random.between(1, 6), random.between(1, 6), random.between(1, 6)};
      volume.yaw_rad = random.between(-3, 3);
    }
    volume.material = i % 3;
    scene.volumes.push_back(std::move(volume));
  }
  return volume_table(scene);
}

std::vector<PathRow> random_paths(Random& random, uint32_t count) {
  std::vector<PathRow> rows(count);
  const auto place = [&] {
    return glm::dvec3(random.between(-60, 60), random.between(-60, 60), random.between(0, 20));
  };
  for (uint32_t i = 0; i < count; ++i) {
    rows[i].from = place();
    rows[i].to = i % 7 == 0 ? rows[i].from + glm::dvec3(20, 0, 0) : place();  // along an axis, too
    for (uint32_t k = 0; k < i % 4; ++k) {
      rows[i].steps.push_back(k);
      rows[i].points.push_back(place());
    }
  }
  return rows;
}

std::vector<double> by_all_volumes(const VolumeTable& table, const std::vector<PathRow>& rows) {
  const size_t kinds = table.material.size();
  std::vector<uint64_t> parts(rows.size() * kinds);
  for (size_t i = 0; i < rows.size(); ++i)
    for (size_t leg = 0; leg <= rows[i].points.size(); ++leg)
      for (uint32_t k = 0; k < table.volumes.size(); ++k)
        parts[i * kinds + table.volumes[k].kind] += device::wt_parts_of_length(
            device::wt_length_in_space(table.all(), k, leg == 0 ? rows[i].from : rows[i].points[leg - 1],
                                       leg == rows[i].points.size() ? rows[i].to : rows[i].points[leg]));
  std::vector<double> out;
  for (const uint64_t sum : parts) out.push_back(device::wt_length_of_parts(sum));
  return out;
}

}  // namespace

TEST_CASE("vegetation: lengths inside, kind by kind, as by asking every volume") {
  Random random(5);
  Counters counters(context());
  for (const auto& [volumes, paths] : std::vector<std::array<uint32_t, 2>>{{1, 5}, {2, 20}, {60, 60}}) {
    const VolumeTable table = random_volumes(random, volumes);
    const std::vector<PathRow> rows = random_paths(random, paths);
    Vegetation vegetation(context(), table);
    const SolvedList list = upload_rows(rows, 3);
    const RadioEnds ends = ends_of(rows);
    const std::vector<double> wanted = by_all_volumes(table, rows);
    const std::vector<double> lengths = vegetation(ends, list, counters).read(0, wanted.size());
    CHECK(lengths == wanted);  // to the last bit, in whatever order the tree meets the volumes
    if (volumes == 60) CHECK(std::ranges::count_if(wanted, [](double x) { return x > 0; }) > 50);
  }
}

TEST_CASE("vegetation: no paths, and a length that only the device knows") {
  Random random(6);
  Counters counters(context());
  const VolumeTable table = random_volumes(random, 8);
  Vegetation vegetation(context(), table);
  SolvedList none;
  none.max_depth = 3;
  const std::vector<PathRow> rows = random_paths(random, 12);
  const RadioEnds ends = ends_of(rows);
  vegetation(ends, none, counters);
  SolvedList list = upload_rows(rows, 3);
  list.counter = counter_word(&wt_counters::visible);
  counters.restart(&wt_counters::visible, 4, Stage::transfer);
  vegetation(ends, upload_rows(rows, 3), counters);  // all of them
  const std::vector<double> all = vegetation(ends, list, counters).read(0, rows.size() * table.material.size());
  const std::vector<double> wanted = by_all_volumes(table, rows);
  for (size_t i = 0; i < 4 * table.material.size(); ++i) CHECK(all[i] == wanted[i]);
}
