// SPDX-License-Identifier: Apache-2.0
// Vegetation that overlaps: lengths of legs and cells, against points that are inside or not.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "radio/cells.hpp"
#include "radio/leaves.hpp"

using namespace wavetracer;
using namespace test;

TEST_CASE("volumes that overlap: every metre is that of the first that holds it, against points") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> u(-1, 1);
  int shared = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    std::vector<Volume> shapes, volumes;
    for (int k = 0; k < 5; ++k) {
      const auto shape = std::array{VolumeShape::box, VolumeShape::cylinder, VolumeShape::spheroid}[k % 3];
      shapes.push_back(shaped(shape, 2.0 * glm::dvec3(u(random), u(random), u(random)),
                              glm::dvec3(2 + u(random), 2 + u(random), 2 + u(random)), 3 * u(random)));
      const bool as_mesh = shape == VolumeShape::box && repeat % 2 == 1;
      volumes.push_back(as_mesh ? mesh_volumes(box_mesh(shapes.back()), 0).at(0) : shapes.back());
      volumes.back().material = static_cast<uint32_t>(k);
    }
    const VolumeTable table = table_of(volumes);
    const glm::dvec3 from = 8.0 * glm::dvec3(u(random), u(random), u(random)),
                     to = 8.0 * glm::dvec3(u(random), u(random), u(random));
    constexpr int points = 20000;
    std::array<int, 5> first{};
    for (int i = 0; i < points; ++i) {
      const glm::dvec3 p = from + (to - from) * ((i + 0.5) / points);
      const auto holds = [&](const Volume& v) { return is_inside(v, p); };
      const auto at = std::ranges::find_if(shapes, holds);
      if (at == shapes.end()) continue;
      ++first[static_cast<size_t>(at - shapes.begin())];
      shared += std::ranges::count_if(shapes, holds) > 1;
    }
    for (uint32_t k = 0; k < 5; ++k) {
      const double length = device::wt_length_in_space(table.all(), k, from, to);
      CHECK(std::abs(length - first[k] * glm::distance(from, to) / points) <= 5 * glm::distance(from, to) / points);
      CHECK(std::abs(length - device::wt_length_in_space(table.all(), k, to, from)) < 1e-9);
    }
  }
  CHECK(shared > 30000);
}

TEST_CASE("volumes that only touch, or that a leg meets one after the other, have their lengths to the last bit") {
  const std::vector<Volume> volumes = {shaped(VolumeShape::spheroid, {0, 0, 0}, {2, 2, 2}),
                                       shaped(VolumeShape::spheroid, {3, 3, 0}, {2, 2, 2}),
                                       shaped(VolumeShape::box, {6, 6, 0}, {1.5, 1.5, 2})};
  const VolumeTable together = table_of(volumes);
  CHECK(together.earlier.size() == 4 + 2);
  const glm::dvec3 from{-7.3, -7.1, 0.2}, to{9.1, 9.4, 0.3};
  for (uint32_t k = 0; k < 3; ++k)
    CHECK(device::wt_length_in_space(together.all(), k, from, to) ==
          device::wt_length_in_space(table_of({volumes[k]}).all(), 0, from, to));
}

TEST_CASE("cells of volumes that overlap: together they are what both hold, and a cell is of the first") {
  Scene scene;
  scene.materials = {{.name = "leaves", .scattering = 0.5, .vegetation = VegetationLaw{}}};
  scene.volumes = {shaped(VolumeShape::box, {0, 0, 0}, {2, 2, 2}), shaped(VolumeShape::box, {2, 0, 0}, {2, 2, 2}),
                   shaped(VolumeShape::box, {0, 9, 0}, {1, 1, 1})};
  const auto cubic_metres = [&](const std::vector<Cell>& cells, uint32_t volume) {
    double out = 0;
    for (const Cell& cell : cells) out += cell.volume == volume ? cell.volume_m3 : 0;
    return out;
  };
  const std::vector<Cell> cells = make_cells(scene, 0.5, 100000);
  CHECK(cubic_metres(cells, 0) == doctest::Approx(64));
  CHECK(cubic_metres(cells, 1) == doctest::Approx(32));
  CHECK(cubic_metres(cells, 2) == doctest::Approx(8));
  scene.materials.push_back({.name = "dull", .vegetation = VegetationLaw{}});
  scene.volumes[0].material = 1;  // this material does not scatter, and still has the space
  CHECK(cubic_metres(make_cells(scene, 0.5, 100000), 1) == doctest::Approx(32));
}
