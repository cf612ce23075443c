// SPDX-License-Identifier: Apache-2.0
// A 3D city as its reader returns it, from CityJSON or CityGML: polygons in space with their roles, in the coordinates
// of the file. Corners are finite; imports/model_faces.hpp checks the rest.
#pragma once
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "imports/imports.hpp"

namespace wavetracer::imports {

using SpaceRing = std::vector<glm::dvec3>;  // the first corner may be repeated at the end

// The role of a surface in its building. Without semantics its slope decides.
enum class Role { unknown, wall, roof, ground, window, door };

struct ModelFace {
  Role role = Role::unknown;
  std::vector<SpaceRing> rings;  // the outer one first, then its holes
};

constexpr size_t no_parent = ~size_t{0};

struct ModelObject {
  std::string id;             // the id in the file
  size_t parent = no_parent;  // index in CityModel::objects, always lower than its own: the building that this is a
                              // part or fitting of
  bool part = false;  // true for BuildingPart and BridgePart, which are buildings in their own right; false for a
                      // building or a fitting
  std::map<double, std::vector<ModelFace>> faces;  // faces of the requested levels, by level of detail
};

struct CityModel {
  std::vector<ModelObject> objects;
  std::string system;  // the coordinate system as the file names it; empty if it does not
  std::map<std::string, uint64_t> left_out, guessed;
  std::vector<std::string> warnings;
};

bool is_cityjson(std::string_view first_bytes);
bool is_citygml(std::string_view first_bytes);

// Both throw InputError that names the file and the place in it.
CityModel read_cityjson(std::string_view content, const std::string& name, const ImportOptions& options);
CityModel read_citygml(std::string_view content, const std::string& name, const ImportOptions& options);

// The readers share the following functions.

// Tells whether objects of this type are built (both formats have the same names); other types are counted if `model`
// is given.
bool is_built(std::string_view type, CityModel& model);
// Returns the role of a surface of this type; for a surface that waves do not meet, it returns nothing and counts it.
std::optional<Role> role_of(std::string_view type, CityModel& model);
// Returns the level of detail below which geometry is used: "2" uses everything below 3, "1.2" everything up to 1.2.
// Throws ConfigError.
double lod_limit(const std::string& lod);
// Keeps one level of each object, the highest; drops a building's own geometry if its parts have more detail, and parts
// that have less detail than their building.
void choose_levels(CityModel& model);
// Makes text of a file safe to print in a message.
std::string printable(std::string_view text);

}  // namespace wavetracer::imports
