// Trees and woods of OpenStreetMap as prisms of leaves: what their tags say, and what is assumed where they say
// nothing. Keys are those of https://wiki.openstreetmap.org/wiki/Tag:natural=tree.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "imports/building_tags.hpp"

namespace wavetracer::imports {

constexpr double tree_distance_m = 8;  // of trees in a row
// A line across the world has few bytes and very many trees.
constexpr size_t most_trees_of_row = 1000, most_trees_of_rows = 200000;

// Whether a material is leaves and twigs (host/scene/materials.hpp).
bool is_vegetation(std::string_view material);

// Height and width of the crown, in metres: height and diameter_crown; else 10 m, and half of the height, or of needles
// a third.
struct TreeSize {
  double height_m, crown_m;
};
TreeSize tree_size(const Tags& tags);

// A crown from above: eight corners around a place in degrees (longitude, latitude), of the area of the circle.
std::vector<glm::dvec2> crown_ring(const glm::dvec2& place_deg, double crown_m);

// Trees along a line in degrees, from its beginning on, tree_distance_m from each other; of a line that is too long for
// most_trees_of_row, one more than these.
std::vector<glm::dvec2> planted(const std::vector<glm::dvec2>& line_deg);

// Of a tree the crown, from a third of its height on; of a wood all of it from the ground on, 15 m high if nothing is
// said. leaf_type=broadleaved is deciduous vegetation, all else mixed.
Shape vegetation_shape(const Tags& tags, std::map<std::string, uint64_t>& guessed);

}  // namespace wavetracer::imports
