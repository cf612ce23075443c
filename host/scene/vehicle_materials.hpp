// SPDX-License-Identifier: Apache-2.0
// Materials of vehicles and people, which Recommendation ITU-R P.2040 does not have.
// Assumes nothing about a scene; the ranges are those that the sources give.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/itu_materials.hpp"

namespace wavetracer {

struct VehicleMaterial {
  Material law;
  const char* source;  // source of its values
};

// Returns all laws, grouped by name; ranges of one name touch but do not overlap.
const std::vector<VehicleMaterial>& vehicle_materials();

// Returns all names, separated by commas.
std::string vehicle_material_names();

// Works as find_itu_law().
std::optional<ItuLaw> find_vehicle_law(std::string_view name, double frequency_ghz);

}  // namespace wavetracer
