// SPDX-License-Identifier: Apache-2.0
// A rough room with a partition, and its paths that scatter as rows that tests compare.
#pragma once
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "simulation/run.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer::test {

using Steps = std::vector<std::pair<uint8_t, uint32_t>>;  // kinds and surfaces
using PathOfTile = std::tuple<uint32_t, uint32_t, Steps>;
using PathsOfTiles = std::multimap<PathOfTile, std::vector<glm::dvec3>>;

inline std::vector<Quad> room_walls(const glm::dvec3& size) { return reference::box_walls({0, 0, 0}, size); }

inline Config rough_room(const SceneFile& file, const Points& from, const Points& to, uint32_t reflections) {
  Config config = config_of(file.path(), from, to, 1000, 5);
  MaterialConfig& wall = config.materials.emplace_back();
  wall.name = "concrete";
  wall.scattering = 0.5;
  config.trace.discovery = "beams";
  config.trace.scattering = true;
  config.trace.tile_m = 3;
  config.trace.scattering_reflections = reflections;
  return config;
}

inline bool scatters(const Paths& paths, size_t i) {
  for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
    if (paths.vertex_interaction[k] == scattering) return true;
  return false;
}

inline PathsOfTiles scattered_paths(const Paths& paths) {
  PathsOfTiles out;
  for (size_t i = 0; i < paths.size(); ++i) {
    if (!scatters(paths, i)) continue;
    Steps steps;
    std::vector<glm::dvec3> points;
    for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
      steps.emplace_back(paths.vertex_interaction[k], paths.vertex_surface[k]);
      points.push_back(paths.vertex_position_m[k]);
    }
    out.emplace(PathOfTile{paths.tx[i], paths.rx[i], steps}, points);
  }
  return out;
}

inline double farthest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double out = 0;
  for (size_t k = 0; k < a.size(); ++k) out = std::max(out, glm::distance(a[k], b[k]));
  return out;
}

// Every path of each has its place in the other.
inline void check_equal(const PathsOfTiles& found, const PathsOfTiles& wanted) {
  CHECK(found.size() == wanted.size());
  size_t missing = 0;
  for (const auto& [key, points] : wanted) {
    const auto [first, last] = found.equal_range(key);
    missing += std::none_of(first, last, [&](const auto& other) { return farthest(other.second, points) < 1e-9; });
  }
  CHECK(missing == 0);
}

inline const glm::dvec3 room_size{7.3, 5.1, 3.2};

inline std::vector<Quad> partitioned_room() {
  std::vector<Quad> quads = room_walls(room_size);
  quads.push_back({{3.13, 0, 0}, {0, 2.9, 0}, {0, 0, 3.2}});
  return quads;
}

inline const Points room_from{{1.21, 1.37, 1.83}, {5.91, 4.13, 2.41}}, room_to{{4.77, 0.83, 1.19}, {2.03, 4.41, 0.71}};

}  // namespace wavetracer::test
