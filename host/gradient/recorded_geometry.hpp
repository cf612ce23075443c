// SPDX-License-Identifier: Apache-2.0
// The geometry of paths from their columns: the way back from the rows of a frame to what fields are computed from.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wavetracer/config.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

class RecordedGeometry {
 public:
  // It keeps references to the scene, the models and the instances. config: that of the frames.
  RecordedGeometry(const Scene& scene, const Config& config, std::span<const Scene> models,
                   std::span<const Instance> instances);

  // Returns row i of the paths as row i. Vertices are recentred, so they differ from those that were solved by the
  // rounding of file coordinates. Throws RuntimeError if a path scatters where the world has no tile and no cell.
  PathGeometry operator()(const Paths& paths, const WorldState& state);

 private:
  // A tile or cell of the world.
  struct Place {
    uint32_t surface;   // its number in columns: that of the surface in the world; for a cell that of its volume
    double along;       // its distance from the origin along a direction that separates places
    glm::dvec3 centre;  // in the coordinates of its scene or model
    uint32_t number;    // the number of the tile or cell in the world
  };
  void list_places();
  uint32_t tile_of(uint32_t surface, const glm::dvec3& vertex);
  uint32_t number_of(const Paths& paths, uint64_t vertex, const WorldState& state);

  const Scene& scene_;
  double tile_m_;
  std::span<const Scene> models_;
  std::span<const Instance> instances_;
  std::optional<std::vector<Place>> places_;  // sorted; made when the first path scatters
};

}  // namespace wavetracer
