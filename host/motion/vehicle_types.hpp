// SPDX-License-Identifier: Apache-2.0
// Sizes of vehicles by the name of their type, because FCD files hold names only.
// A type without a size from the user is assumed to be named after its vehicle class.
#pragma once
#include <optional>
#include <string_view>

#include "motion/trajectories.hpp"

namespace wavetracer {

// Returns the size that SUMO gives to a vehicle class, found by the name of a type in upper or lower case: the whole
// name, else its first word that names a class ("veh_passenger", "truck2", "Bus/articulated"), as SUMO's own tools name
// types. It also knows SUMO's DEFAULT_VEHTYPE and similar names, and the words car, van, lorry and bike.
std::optional<VehicleType> sumo_type(std::string_view name);

// Returns the name of that class in lower case; empty if there is none.
std::string_view vehicle_class(std::string_view name);

// Throws ConfigError unless all sizes are positive.
void check_type(const VehicleType& type);

}  // namespace wavetracer
