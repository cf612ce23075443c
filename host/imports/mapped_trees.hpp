// SPDX-License-Identifier: Apache-2.0
// Trees of maps that GDAL reads: points and lines with the tags of OpenStreetMap, which become outlines of crowns.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "imports/map.hpp"
#include "imports/vegetation_tags.hpp"

namespace wavetracer::imports {

// A tree, or a row of trees.
struct MappedTrees {
  std::string id, name;
  std::vector<glm::dvec2> line;  // one place: a tree
  Tags tags;
};

// Is a point with these tags a tree? It is one with natural=tree, and where its layer does not say what it is, as
// tables of trees do not, one with a diameter of its crown.
bool is_tree_point(const Tags& tags);
bool is_row_line(const Tags& tags);

// Adds them to the footprints of the map, whose places have this unit, as is done with those of OpenStreetMap.
void plant(Map& map, const std::vector<MappedTrees>& trees, MapUnit unit);

}  // namespace wavetracer::imports
