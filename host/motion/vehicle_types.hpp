// Sizes of vehicles by the name of their type, because FCD files hold names only.
// Assumes that a type is named after its vehicle class where the user gives no size for it.
#pragma once
#include <optional>
#include <string_view>

#include "motion/trajectories.hpp"

namespace wavetracer {

// The size that SUMO gives to a class of vehicles, found by the name of a type in any case: the whole name, else its
// first word that names a class ("veh_passenger", "truck2", "Bus/articulated"), as SUMO's own tools name types. Also
// SUMO's DEFAULT_VEHTYPE and its like, and the common words car, van, lorry and bike.
std::optional<VehicleType> sumo_type(std::string_view name);

// The name of that class, in small letters; empty where there is none.
std::string_view vehicle_class(std::string_view name);

// Throws ConfigError unless all sizes are positive.
void check_type(const VehicleType& type);

}  // namespace wavetracer
