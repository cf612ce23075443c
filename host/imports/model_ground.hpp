// How a building of a city model stands on the ground: what its surfaces are, which corners are its feet.
// Assumes that a building and its parts stand together: they are moved as one.
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

// Which way surfaces look, and what those are that do not say it: told by their slope.
void tell_roles(Body& body);

int64_t lowest_corner(const Family& family);

// Corners that stand on the ground: those of ground surfaces less than a storey above the lowest corner, since what is
// higher is a passage or a bay. Without ground surfaces, the lowest corner of walls at each place. Needs roles.
std::set<GridCorner> feet_of(const Family& family, int64_t lowest, double storey_m);

// The lowest terrain below a building; empty where it reaches beyond it. Infinite where nothing of it says where it is.
std::optional<double> terrain_below(const Ground& ground, const Family& family);

// Sets the feet to one height, and lifts all else. Walls between feet, of steps in the ground, come to nothing.
void move(Family& family, const std::set<GridCorner>& feet, int64_t foot, int64_t rise);

}  // namespace wavetracer::imports
