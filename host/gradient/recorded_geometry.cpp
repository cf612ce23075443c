// SPDX-License-Identifier: Apache-2.0
// Columns name the surface that a tile belongs to, so tiles are found by their places.
#include "gradient/recorded_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <tuple>

#include "radio/cells.hpp"
#include "scene/tiles.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Coordinates of files may have rounded; tiles are much larger.
constexpr double most_rounding_m = 1e-5;

// No face and no grid of a scene is likely to be at right angles to this direction.
double along(const glm::dvec3& p) { return glm::dot(p, glm::dvec3(0.5403, 0.6421, 0.5437)); }

}  // namespace

RecordedGeometry::RecordedGeometry(const Scene& scene, const Config& config, std::span<const Scene> models,
                                   std::span<const Instance> instances)
    : scene_(scene), tile_m_(config.trace.tile_m), models_(models), instances_(instances) {}

PathGeometry RecordedGeometry::operator()(const Paths& paths, const WorldState& state) {
  PathGeometry out{.tx = paths.tx,
                   .rx = paths.rx,
                   .quarters = paths.quarters,
                   .first = paths.vertex_offset,
                   .surface = {},
                   .interaction = paths.vertex_interaction,
                   .vertex = {}};
  for (uint64_t vertex = 0; vertex < paths.vertex_surface.size(); ++vertex) {
    out.surface.push_back(number_of(paths, vertex, state));
    out.vertex.push_back(paths.vertex_position_m[vertex] - scene_.origin_m);
  }
  return out;
}

uint32_t RecordedGeometry::number_of(const Paths& paths, uint64_t vertex, const WorldState& state) {
  const uint32_t own = paths.vertex_surface[vertex], instance = paths.vertex_instance[vertex];
  const bool moves = instance != no_instance;
  if (paths.vertex_interaction[vertex] == diffraction) return own + (moves ? instances_[instance].first_wedge : 0);
  const uint32_t surface = own + (moves ? instances_[instance].first_surface : 0);
  if (paths.vertex_interaction[vertex] != scattering) return surface;
  const glm::dvec3 point = paths.vertex_position_m[vertex] - scene_.origin_m;
  if (!moves) return tile_of(surface, point);
  const Placement& body = state.instances[instance];
  return tile_of(surface, glm::transpose(body.rotation) * (point - body.position_m));
}

void RecordedGeometry::list_places() {
  std::vector<Place>& places = places_.emplace();
  const TileTable tiles(scene_, models_, instances_, tile_m_);
  for (uint32_t id = 0; id < tiles.size(); ++id) {
    const TilePlace place = tiles.at(id);
    const glm::dvec3 centre = tiles.tile(place).centre_m;
    places.push_back({tiles.surface(place), along(centre), centre, id});
  }
  uint32_t number = tiles.size();
  for (const Cell& cell : make_cells(scene_, tile_m_, TileTable::most_tiles - tiles.size()))
    places.push_back(
        {static_cast<uint32_t>(scene_.surfaces.size()) + cell.volume, along(cell.centre_m), cell.centre_m, number++});
  std::ranges::sort(places, {}, [](const Place& place) { return std::tuple(place.surface, place.along); });
}

uint32_t RecordedGeometry::tile_of(uint32_t surface, const glm::dvec3& vertex) {
  if (!places_) list_places();
  const auto key = [](const Place& place) { return std::pair(place.surface, place.along); };
  const double at = along(vertex);
  for (auto place = std::ranges::lower_bound(*places_, std::pair(surface, at - 2 * most_rounding_m), {}, key);
       place != places_->end() && key(*place) <= std::pair(surface, at + 2 * most_rounding_m); ++place)
    if (glm::distance(place->centre, vertex) <= most_rounding_m) return place->number;
  throw RuntimeError(fmt::format(
      "a path scatters at ({:.3f}, {:.3f}, {:.3f}), where surface {} has no tile: the frame is of another simulation",
      vertex.x, vertex.y, vertex.z, surface));
}

}  // namespace wavetracer
