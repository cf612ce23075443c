// SPDX-License-Identifier: Apache-2.0
// Finds how a building of a city model stands on the ground: the roles of its surfaces, and the corners that are its
// feet. A building and its parts are moved together.
#pragma once
#include <optional>
#include <set>
#include <vector>

#include "imports/model_faces.hpp"
#include "scene/ground.hpp"

namespace wavetracer::imports {

struct Body {
  const ModelObject* object;
  std::vector<GridFace> faces;
  bool inward = false;  // its surfaces look inward
};
using Family = std::vector<Body>;  // a building and its parts

// Finds the orientation of surfaces, and the roles of those without one, from their slope.
void tell_roles(Body& body);

int64_t lowest_corner(const Family& family);

// Returns the corners that stand on the ground: those of ground surfaces less than a storey above the lowest corner,
// since a higher one belongs to a passage or a bay. Without ground surfaces, it is the lowest corner of walls at each
// place. Roles must be known.
std::set<GridCorner> feet_of(const Family& family, int64_t lowest, double storey_m);

// Returns the lowest terrain below a building; nothing if the building reaches beyond the terrain; infinity if the
// building has no corner.
std::optional<double> terrain_below(const Ground& ground, const Family& family);

// Sets the feet to one height, and lifts all other corners. Walls between feet, such as steps in the ground, become
// empty.
void move(Family& family, const std::set<GridCorner>& feet, int64_t foot, int64_t rise);

}  // namespace wavetracer::imports
