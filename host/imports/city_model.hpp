// A city in three dimensions as its reader hands it over, CityJSON or CityGML: polygons in space with their roles, in
// the coordinates of the file. Assumes nothing of the polygons but finite corners: imports/model_faces.hpp checks them.
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

// What a surface is of a building. Without semantics it is told by its slope.
enum class Role { unknown, wall, roof, ground, window, door };

struct ModelFace {
  Role role = Role::unknown;
  std::vector<SpaceRing> rings;  // the outer one first, then its holes
};

constexpr size_t no_parent = ~size_t{0};

struct ModelObject {
  std::string id;             // as in the file
  size_t parent = no_parent;  // into CityModel::objects, always lower: the building that this is a part or fitting of
  bool part = false;          // BuildingPart, BridgePart: a building in its own right; else a building, or a fitting
  std::map<double, std::vector<ModelFace>> faces;  // by level of detail, those that are asked for
};

struct CityModel {
  std::vector<ModelObject> objects;
  std::string system;  // the coordinate system as the file names it; empty: it does not
  std::map<std::string, uint64_t> left_out, guessed;
  std::vector<std::string> warnings;
};

bool is_cityjson(std::string_view first_bytes);
bool is_citygml(std::string_view first_bytes);

// Both throw InputError that names the file and the place in it.
CityModel read_cityjson(std::string_view content, const std::string& name, const ImportOptions& options);
CityModel read_citygml(std::string_view content, const std::string& name, const ImportOptions& options);

// What the readers share.

// Whether objects of this type, named alike in both formats, are built; those that are not are counted, `model` given.
bool is_built(std::string_view type, CityModel& model);
// The role of a surface of this type; empty, and counted, where it is none that waves meet.
std::optional<Role> role_of(std::string_view type, CityModel& model);
// The level of detail below which geometry is asked for: "2" asks for everything below 3, "1.2" for 1.2 and less.
// Throws ConfigError.
double lod_limit(const std::string& lod);
// Keeps one level of each object, the highest; nothing of a building whose parts are there in more detail, and nothing
// of parts that are there in less detail than the building around them.
void choose_levels(CityModel& model);
// Text of a file as a message may show it.
std::string printable(std::string_view text);

}  // namespace wavetracer::imports
