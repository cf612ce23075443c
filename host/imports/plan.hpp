// SPDX-License-Identifier: Apache-2.0
// Decides which solids stand where: footprints are checked, courtyards cut out, outlines replaced by their parts.
// Footprints that are not built are counted with their reason.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "imports/building_tags.hpp"
#include "imports/map.hpp"
#include "imports/rings.hpp"
#include "imports/vegetation_tags.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer::imports {

struct Solid {
  std::string id, name;
  bool part = false;  // it comes from building:part
  Polygon polygon;
  std::vector<Triangle> triangles;  // triangles of the polygon
  Shape shape;
  Ring outline = {};  // outline of the building that it is a part of; empty if there is none
  double base_m = 0;  // height of the ground that it stands on
  bool is_building() const { return shape.plant == Plant::none; }
};

struct Plan {
  std::vector<Solid> solids;
  glm::dvec2 offset_m{0, 0};  // coordinates of the solids = those of the map + offset_m; zero if they are small enough
  Extent traffic;             // area that the ground must cover besides the solids, in their coordinates
  std::map<std::string, uint64_t> left_out, guessed;
  std::vector<std::string> warnings;
  uint64_t straightened = 0;     // number of corners that were moved onto straight walls (imports/straight_walls.hpp)
  double straightened_by_m = 0;  // the largest move
};

// Returns the shift by whole metres that brings all solids near the origin; zero if they are there already, since the
// coordinates may be those of vehicles. Throws InputError if the map is too wide.
glm::dvec2 shift_to_origin(const Extent& extent, const std::string& name);
// Returns the area that the ground must cover besides the buildings, in coordinates of the scene: the network, and the
// traffic of options. Throws InputError if it is too far away.
Extent extent_to_reach(const Extent& network, const glm::dvec2& offset_m, const std::string& name,
                       const ImportOptions& options);

// Throws InputError if the map is wider than a scene can be.
Plan plan_city(const Map& map, const std::string& name, const ImportOptions& options);

}  // namespace wavetracer::imports
