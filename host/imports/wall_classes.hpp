// SPDX-License-Identifier: Apache-2.0
// Classes of outer walls: what they are made of, how thick and how rough they are, by published sources. A scene names
// the class of each wall, and materials.toml beside it has the [[material]] tables of the classes.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "imports/building_tags.hpp"

namespace wavetracer::imports {

struct WallLayer {
  const char* material;  // ITU name
  double thickness_m;
};

struct WallClass {
  const char* name;  // such as "brick_wall"
  const char* itu;   // the ITU material that tags name, and that the scene file has
  double thickness_m;
  std::vector<WallLayer> layers;  // from outside; empty: a slab of the ITU material
  double scattering;              // S; 0: smooth
  int lobe;
  const char *why_thick, *why_rough;  // sources
};

const std::vector<WallClass>& wall_classes();

// Returns the class of this name, or nullptr.
const WallClass* find_wall_class(std::string_view name);

// Returns the name of the class of a building's walls, by the first of building:facade:material, building:cladding and
// building:material that is known, or else by the value of building, or else that of the material `otherwise`. Returns
// `otherwise` if no class is made of it. `guessed` counts what the tags do not say.
std::string wall_class_of(const Tags& tags, const std::string& otherwise, std::map<std::string, uint64_t>& guessed);

// Returns the text of materials.toml: a [[material]] table for each of these classes, with its sources as comments.
std::string wall_tables(const std::vector<std::string>& names);

}  // namespace wavetracer::imports
