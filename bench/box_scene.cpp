// SPDX-License-Identifier: Apache-2.0
// Makes boxes and height fields of triangles, and their OBJ file.
// OBJ counts vertices from 1.
#include "box_scene.hpp"

#include <fmt/format.h>

#include <fstream>

#include "wavetracer/error.hpp"

namespace wavetracer::bench {

void BoxScene::box(const glm::dvec3& centre_m, const glm::dvec3& size_m) {
  const auto first = static_cast<uint32_t>(vertices_.size());
  for (int corner = 0; corner < 8; ++corner)
    vertices_.push_back(centre_m +
                        0.5 * size_m * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
  constexpr uint32_t sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& side : sides) {
    triangles_.push_back({first + side[0], first + side[1], first + side[2]});
    triangles_.push_back({first + side[0], first + side[2], first + side[3]});
  }
}

void BoxScene::height_field(double side_m, uint32_t cells, const std::function<double(glm::dvec2)>& height_m) {
  const auto first = static_cast<uint32_t>(vertices_.size());
  const auto along = [&](uint32_t i) { return (static_cast<double>(i) / cells - 0.5) * side_m; };
  for (uint32_t j = 0; j <= cells; ++j)
    for (uint32_t i = 0; i <= cells; ++i) vertices_.emplace_back(along(i), along(j), height_m({along(i), along(j)}));
  for (uint32_t j = 0; j < cells; ++j)
    for (uint32_t i = 0; i < cells; ++i) {
      const uint32_t here = first + j * (cells + 1) + i, next = here + cells + 1;
      triangles_.push_back({here, here + 1, next + 1});
      triangles_.push_back({here, next + 1, next});
    }
}

void BoxScene::write(const std::filesystem::path& file) const {
  std::ofstream out(file);
  for (const glm::dvec3& v : vertices_) out << fmt::format("v {:.6f} {:.6f} {:.6f}\n", v.x, v.y, v.z);
  for (const auto& [a, b, c] : triangles_) out << fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  out.close();
  if (!out) throw RuntimeError(fmt::format("cannot write {}: is there room in its folder?", file.string()));
}

}  // namespace wavetracer::bench
