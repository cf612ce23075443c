// SPDX-License-Identifier: Apache-2.0
// Names of the types of CityGML 2.0 and CityJSON 1.0 to 2.0, and the choice of the level of detail that is built.
// A name that is unknown here is taken for one of an extension or of a later version.
#include "imports/city_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr size_t most_reasons = 50;  // a report of thousands of types would not help

constexpr auto built_types = std::to_array<std::string_view>(
    {"Building", "BuildingPart", "BuildingInstallation", "Bridge", "BridgePart", "BridgeInstallation",
     "BridgeConstructionElement", "BridgeConstructiveElement", "OtherConstruction"});

struct SurfaceType {
  std::string_view type;
  Role role;
};
constexpr auto surface_types = std::to_array<SurfaceType>({
    {"RoofSurface", Role::roof},
    {"WallSurface", Role::wall},
    {"GroundSurface", Role::ground},
    {"OuterFloorSurface", Role::roof},
    {"OuterCeilingSurface", Role::wall},
    {"Window", Role::window},
    {"Door", Role::door},
});
constexpr auto inner_surfaces =
    std::to_array<std::string_view>({"InteriorWallSurface", "FloorSurface", "CeilingSurface"});

void leave_out(CityModel& model, const std::string& reason, const char* otherwise) {
  ++model.left_out[model.left_out.size() < most_reasons || model.left_out.contains(reason) ? reason : otherwise];
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out(text.substr(0, 60));
  std::ranges::replace_if(
      out, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7F; }, ' ');
  return out;
}

bool is_built(std::string_view type, CityModel& model) {
  if (std::ranges::find(built_types, type) != built_types.end()) return true;
  leave_out(model, fmt::format("object of the type '{}'", printable(type)), "object of another type");
  return false;
}

std::optional<Role> role_of(std::string_view type, CityModel& model) {
  const auto* const found = std::ranges::find(surface_types, type, &SurfaceType::type);
  if (found != surface_types.end()) return found->role;
  if (type == "ClosureSurface") {
    ++model.left_out["ClosureSurface, where nothing is"];
    return {};
  }
  if (std::ranges::find(inner_surfaces, type) != inner_surfaces.end()) {
    ++model.left_out["surface inside of a building"];
    return {};
  }
  ++model.guessed["surface of an unknown type: told by its slope"];
  return Role::unknown;
}

double lod_limit(const std::string& lod) {
  if (lod.empty()) return 3;
  const bool digits = !lod.empty() && lod[0] >= '1' && lod[0] <= '3';
  const bool short_form = lod.size() == 1;
  const bool long_form = lod.size() == 3 && lod[1] == '.' && lod[2] >= '0' && lod[2] <= '9';
  if (!digits || !(short_form || long_form))
    throw ConfigError(fmt::format(
        "--lod {}: the level of detail must be 1, 2 or 3, or one of CityJSON's finer ones, such as 1.2 or 2.2", lod));
  const double whole = lod[0] - '0';
  return short_form ? whole + 1 : whole + (lod[2] - '0') / 10.0 + 0.05;
}

// A building and its parts are one body, so they get one level of detail: the highest level of an object and its parts
// is built. Parts beside each other may differ, since they have no volume in common.
void choose_levels(CityModel& model) {
  std::vector<ModelObject>& objects = model.objects;
  const auto own_level = [](const ModelObject& object) {
    return object.faces.empty() ? 0 : object.faces.rbegin()->first;
  };
  std::vector<double> of_parts(objects.size(), 0);  // for each object, the highest level of its parts
  for (size_t i = objects.size(); i-- > 0;) {
    const ModelObject& object = objects[i];
    if (object.parent != no_parent && object.part)
      of_parts[object.parent] = std::max({of_parts[object.parent], own_level(object), of_parts[i]});
  }
  std::vector<double> around(objects.size(), 0);  // for each part, the level of the building that it belongs to
  for (size_t i = 0; i < objects.size(); ++i) {
    ModelObject& object = objects[i];
    const double own = own_level(object);
    if (object.parent != no_parent && object.part) around[i] = around[object.parent];
    if (own > 0 && own < of_parts[i]) {
      object.faces.clear();
      ++model.left_out["building whose parts are built in more detail instead"];
    } else if (own > 0 && own < around[i]) {
      object.faces.clear();
      ++model.left_out["part of a building that is built in more detail instead"];
    }
    if (!object.faces.empty()) around[i] = std::max(around[i], own);
    while (object.faces.size() > 1) object.faces.erase(object.faces.begin());
  }
}

}  // namespace wavetracer::imports
