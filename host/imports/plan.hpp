// Which solids stand where: footprints checked, courtyards cut out, outlines left to their parts.
// Assumes a map as its reader gives it; whatever is not built is counted with its reason.
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
  bool part = false;  // of building:part
  Polygon polygon;
  std::vector<Triangle> triangles;  // of the polygon
  Shape shape;
  Ring outline = {};  // of the building that it is a part of; empty where there is none
  double base_m = 0;  // the ground that it stands on
  bool is_building() const { return !is_vegetation(shape.walls); }
};

struct Plan {
  std::vector<Solid> solids;
  glm::dvec2 offset_m{0, 0};  // coordinates of the solids = those of the map + this; zero where they are small enough
  Extent traffic;             // what the ground has to reach besides the solids, in their coordinates
  std::map<std::string, uint64_t> left_out, guessed;
  std::vector<std::string> warnings;
  uint64_t straightened = 0;     // corners that were moved onto straight walls (imports/straight_walls.hpp)
  double straightened_by_m = 0;  // the farthest
};

// The shift by whole metres that brings all that is built near the origin; none where it is there already, since the
// coordinates may be those of vehicles. Throws InputError where it is too wide.
glm::dvec2 shift_to_origin(const Extent& extent, const std::string& name);
// What the ground has to reach besides the buildings, in coordinates of the scene: the network, and the traffic of
// options. Throws InputError where it is too far away.
Extent extent_to_reach(const Extent& network, const glm::dvec2& offset_m, const std::string& name,
                       const ImportOptions& options);

// Throws InputError where the map is wider than a scene can be.
Plan plan_city(const Map& map, const std::string& name, const ImportOptions& options);

}  // namespace wavetracer::imports
