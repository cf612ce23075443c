// SPDX-License-Identifier: Apache-2.0
// Makes prisms of leaves for trees and woods of OpenStreetMap, from their tags and from defaults where tags are
// missing. Keys are those of https://wiki.openstreetmap.org/wiki/Tag:natural=tree.
#pragma once
#include <glm/vec2.hpp>
#include <vector>

#include "imports/building_tags.hpp"

namespace wavetracer::imports {

constexpr double tree_distance_m = 8;  // distance between trees of a row
// The limits are needed because a line across the world has few bytes and very many trees.
constexpr size_t most_trees_of_row = 1000, most_trees_of_rows = 200000;
constexpr const char* too_many_trees = "row of more than 1000 trees, or beyond 200,000 trees in rows";

// Tells whether a material is leaves and twigs (host/scene/materials.hpp).
bool is_vegetation(std::string_view material);

// Height and width of the crown, in metres, from the tags height and diameter_crown; the defaults are 10 m, and half of
// the height (as in OSM2World), or a third for needles.
struct TreeSize {
  double height_m, crown_m;
};
TreeSize tree_size(const Tags& tags);

enum class MapUnit { degree, metre };  // the unit of places; those in degrees are longitude and latitude

// Returns a crown seen from above: eight corners around a place, with the area of the circle.
std::vector<glm::dvec2> crown_ring(const glm::dvec2& place, double crown_m, MapUnit unit);

// Returns trees along a line, from its beginning on, tree_distance_m from each other. For a line that is too long, it
// returns most_trees_of_row + 1 trees.
std::vector<glm::dvec2> planted(const std::vector<glm::dvec2>& line, MapUnit unit);

// Returns a tree's crown, from a third of its height on, or a wood from the ground on, 20 m high by default.
// leaf_type=broadleaved gives deciduous vegetation, any other value mixed vegetation. The tag "vegetation" says what it
// is: "tree", "row" for a tree of a row, or "wood". `guessed` counts values that the tags do not give.
Shape vegetation_shape(const Tags& tags, std::map<std::string, uint64_t>& guessed);

}  // namespace wavetracer::imports
