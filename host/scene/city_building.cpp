// SPDX-License-Identifier: Apache-2.0
// Makes closed solids of buildings: extruded cells of a footprint, or a rectangle under a gable.
// Faces wind counter-clockwise seen from outside; neighbouring faces share their corners exactly.
#include "scene/city_building.hpp"

#include <map>

namespace wavetracer::city {
namespace {

using Point = std::array<int, 3>;  // a, b: in the frame; z: grid units

// A mesh that is put together from polygons in a frame; equal points become one vertex.
class MeshBuilder {
 public:
  explicit MeshBuilder(const Frame& frame) : frame_(frame) {}

  // Adds a convex polygon as a fan.
  void add(std::initializer_list<Point> polygon) {
    std::vector<uint32_t> corners;
    for (const Point& p : polygon) corners.push_back(vertex(p));
    for (size_t i = 1; i + 1 < corners.size(); ++i) mesh_.triangles.push_back({corners[0], corners[i], corners[i + 1]});
  }
  RawMesh take() { return std::move(mesh_); }

 private:
  uint32_t vertex(const Point& p) {
    const auto [entry, is_new] = index_.try_emplace(p, static_cast<uint32_t>(mesh_.vertices.size()));
    if (is_new) {
      const int x = frame_.corner[0] + p[0] * frame_.u[0] + p[1] * frame_.v[0];
      const int y = frame_.corner[1] + p[0] * frame_.u[1] + p[1] * frame_.v[1];
      mesh_.vertices.push_back(glm::dvec3(x, y, p[2]) / static_cast<double>(grid_per_m));
    }
    return entry->second;
  }

  Frame frame_;
  RawMesh mesh_;
  std::map<Point, uint32_t> index_;
};

}  // namespace

BuildingMeshes flat_building(const Footprint& footprint, int foundation, int height) {
  MeshBuilder walls(footprint.frame), roof(footprint.frame);
  const auto occupied = [&](int i, int j) {
    return i >= 0 && i < 3 && j >= 0 && j < 3 && ((footprint.cells >> (j * 3 + i)) & 1u) != 0;
  };
  const int low = -foundation;
  // Adds a wall from p to q; the solid is on the left of that direction.
  const auto wall = [&](std::array<int, 2> p, std::array<int, 2> q) {
    walls.add({{p[0], p[1], low}, {q[0], q[1], low}, {q[0], q[1], height}, {p[0], p[1], height}});
  };
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      if (!occupied(i, j)) continue;
      const auto k = static_cast<size_t>(i), l = static_cast<size_t>(j);
      const int a0 = footprint.a[k], a1 = footprint.a[k + 1], b0 = footprint.b[l], b1 = footprint.b[l + 1];
      roof.add({{a0, b0, height}, {a1, b0, height}, {a1, b1, height}, {a0, b1, height}});
      walls.add({{a0, b0, low}, {a0, b1, low}, {a1, b1, low}, {a1, b0, low}});
      if (!occupied(i, j - 1)) wall({a0, b0}, {a1, b0});
      if (!occupied(i + 1, j)) wall({a1, b0}, {a1, b1});
      if (!occupied(i, j + 1)) wall({a1, b1}, {a0, b1});
      if (!occupied(i - 1, j)) wall({a0, b1}, {a0, b0});
    }
  }
  return {walls.take(), roof.take()};
}

BuildingMeshes gabled_building(const Footprint& footprint, int foundation, int eaves, int rise) {
  Frame frame = footprint.frame;
  int length = footprint.a[3] - footprint.a[0], width = footprint.b[3] - footprint.b[0];
  for (size_t k = 0; k < 2; ++k) frame.corner[k] += footprint.a[0] * frame.u[k] + footprint.b[0] * frame.v[k];
  if (length < width) {  // turned by a right angle, so that the ridge runs along the first axis
    for (size_t k = 0; k < 2; ++k) frame.corner[k] += length * frame.u[k];
    const std::array<int, 2> u = frame.u;
    frame.u = frame.v;
    frame.v = {-u[0], -u[1]};
    std::swap(length, width);
  }
  MeshBuilder walls(frame), roof(frame);
  const int low = -foundation, middle = width / 2, ridge = eaves + rise;
  walls.add({{0, 0, low}, {0, width, low}, {length, width, low}, {length, 0, low}});
  walls.add({{0, 0, low}, {length, 0, low}, {length, 0, eaves}, {0, 0, eaves}});
  walls.add({{length, width, low}, {0, width, low}, {0, width, eaves}, {length, width, eaves}});
  walls.add({{0, width, low}, {0, 0, low}, {0, 0, eaves}, {0, middle, ridge}, {0, width, eaves}});
  walls.add(
      {{length, 0, low}, {length, width, low}, {length, width, eaves}, {length, middle, ridge}, {length, 0, eaves}});
  roof.add({{0, 0, eaves}, {length, 0, eaves}, {length, middle, ridge}, {0, middle, ridge}});
  roof.add({{length, width, eaves}, {0, width, eaves}, {0, middle, ridge}, {length, middle, ridge}});
  return {walls.take(), roof.take()};
}

}  // namespace wavetracer::city
