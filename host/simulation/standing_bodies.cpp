// SPDX-License-Identifier: Apache-2.0
// A target that stands has a velocity for Doppler shifts alone, and so has its body.
#include "simulation/standing_bodies.hpp"

#include <fmt/format.h>

#include <glm/gtc/quaternion.hpp>

#include "base/spelling.hpp"
#include "radio/antenna.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Pose standing_pose(const TargetConfig& target, const glm::dvec3& origin_m) {
  return {.position_m = vector_of(target.position_m) - origin_m,
          .orientation = glm::quat_cast(rotation_of(target.orientation_deg)),
          .velocity_m_s = vector_of(target.velocity_m_s),
          .angular_velocity_rad_s = glm::dvec3(0)};
}

std::vector<StandingBody> standing_bodies(const Config& config, VehicleModels& vehicles, const glm::dvec3& origin_m) {
  std::vector<StandingBody> out;
  for (uint32_t i = 0; i < config.targets.size(); ++i) {
    const TargetConfig& target = config.targets[i];
    if (target.vehicle_type.empty()) continue;
    const std::optional<VehicleType> type = vehicles.find_type(target.vehicle_type);
    if (!type) {
      std::vector<std::string> known;
      for (const VehicleType& given : vehicles.given_types()) known.push_back(given.name);
      throw ConfigError(fmt::format(
          "[[target]] \"{}\", vehicle_type = \"{}\": it is neither a [[vehicle_type]] nor a vehicle class of "
          "SUMO{}; add a [[vehicle_type]] with its model",
          target.name, target.vehicle_type, spelling_hint(target.vehicle_type, known)));
    }
    const std::optional<uint32_t> model = vehicles.model_of(*type, target.name);
    if (!model)
      throw ConfigError(fmt::format(
          "[[target]] \"{}\", vehicle_type = \"{}\": this type has no body: give its [[vehicle_type]] a model, "
          "or remove vehicle_type",
          target.name, target.vehicle_type));
    out.push_back({i, *model, type->name, standing_pose(target, origin_m)});
  }
  return out;
}

}  // namespace wavetracer
