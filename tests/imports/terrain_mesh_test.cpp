// SPDX-License-Identifier: Apache-2.0
// The mesh of a terrain against brute force: every post in every triangle.
#include "imports/terrain_mesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace wavetracer;

TEST_CASE(
    "meshes of a terrain: planes are two triangles; of noise every post is a vertex; Euler's formula; the error") {
  std::vector<float> plane, rough;
  std::mt19937 random(1);
  constexpr int columns = 37, rows = 23;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      plane.push_back(static_cast<float>(2 * column - row));
      rough.push_back(static_cast<float>(random() % 1000) / 100);
    }
  CHECK(imports::mesh_terrain(columns, rows, plane, 0.01).triangles.size() == 2);
  for (const double error_m : {0.001, 3.0}) {
    const imports::TerrainMesh mesh = imports::mesh_terrain(columns, rows, rough, error_m);
    if (error_m < 0.01) CHECK(mesh.posts.size() > 800);  // some lie in the planes of others
    int border = 0;
    for (const imports::GridPost& p : mesh.posts)
      border += p.column == 0 || p.row == 0 || p.column == columns - 1 || p.row == rows - 1;
    CHECK(mesh.triangles.size() == 2 * mesh.posts.size() - 2 - static_cast<size_t>(border));
    double area = 0, worst = 0;
    std::vector<int> covered(columns * rows, 0);
    for (const Triangle& t : mesh.triangles) {
      const imports::GridPost a = mesh.posts[t[0]], b = mesh.posts[t[1]], c = mesh.posts[t[2]];
      const auto twice = [](const imports::GridPost& u, const imports::GridPost& v, double x, double y) {
        return (v.column - u.column) * (y - u.row) - (v.row - u.row) * (x - u.column);
      };
      const double whole = twice(a, b, c.column, c.row);
      CHECK(whole > 0);
      area += whole / 2;
      for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
          const double wc = twice(a, b, column, row), wa = twice(b, c, column, row), wb = twice(c, a, column, row);
          if (wa < 0 || wb < 0 || wc < 0) continue;
          covered[static_cast<size_t>(row * columns + column)] = 1;
          const auto h = [&](const imports::GridPost& p) {
            return rough[static_cast<size_t>(p.row * columns + p.column)];
          };
          const double z = (wa * h(a) + wb * h(b) + wc * h(c)) / whole;
          worst = std::max(worst, std::abs(z - rough[static_cast<size_t>(row * columns + column)]));
        }
    }
    CHECK(area == (columns - 1) * (rows - 1));
    CHECK(std::ranges::count(covered, 1) == columns * rows);
    CHECK(worst <= error_m);
    CHECK(imports::terrain_error(mesh, columns, rough).largest_m == doctest::Approx(worst).epsilon(1e-4));
  }
}
