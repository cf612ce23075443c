// SPDX-License-Identifier: Apache-2.0
// Tiles of the surfaces that scatter diffusely: triangles, halved along their longest side until none is longer than
// trace.tile_m. Numbered through a world like surfaces: the static scene's first, then those of each instance.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct Tile {
  glm::dvec3 centre_m;  // centroid, moved onto its surface's plane; in the coordinates of its scene
  double area_m2;
  uint32_t surface;  // into Scene::surfaces
};

// Makes the tiles of all surfaces whose material has scattering > 0, ordered by surface, then by triangle; they depend
// on the scene and tile_m > 0 alone. Where triangles of one plane overlap, only the first one has tiles
// (earlier_faces.hpp).
std::vector<Tile> make_tiles(const Scene& scene, double tile_m);

// A tile of the world, as its scene has it.
struct TilePlace {
  uint32_t part;      // 0: the static scene; 1 + m: model m
  uint32_t tile;      // index in tiles(part)
  uint32_t instance;  // no_instance if static
};

// Keeps a reference to the instances.
class TileTable {
 public:
  // A tile's number and the bits of WT_STEP_KIND share a word; more tiles than this would not fit into a device's
  // memory anyway.
  static constexpr uint64_t most_tiles = uint64_t{1} << 28;

  // Throws ConfigError that names trace.tile_m and a value that is large enough if there are more than `most` tiles; it
  // does so before it allocates memory for them.
  TileTable(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances, double tile_m,
            uint64_t most = most_tiles);

  uint32_t size() const { return size_; }
  uint32_t part_count() const { return static_cast<uint32_t>(parts_.size()); }
  const std::vector<Tile>& tiles(uint32_t part) const { return parts_[part]; }
  std::span<const Instance> instances() const { return instances_; }
  // Returns the number of the first tile of an instance.
  uint32_t first_tile(uint32_t instance) const { return first_[instance]; }

  // id: number of the tile in the world. Throws std::out_of_range if there is none.
  TilePlace at(uint32_t id) const;
  const Tile& tile(const TilePlace& place) const { return parts_[place.part][place.tile]; }
  // Returns the number of the tile's surface in the world.
  uint32_t surface(const TilePlace& place) const {
    return tile(place).surface + (place.instance == no_instance ? 0 : instances_[place.instance].first_surface);
  }

 private:
  std::span<const Instance> instances_;
  std::vector<std::vector<Tile>> parts_;
  std::vector<uint32_t> first_;  // first tile of each instance
  uint32_t size_ = 0;
};

}  // namespace wavetracer
