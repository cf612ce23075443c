// SPDX-License-Identifier: Apache-2.0
// Live worlds: vehicles whose poses come at run time. They take the places that the configuration has for their type.
// Positions are in file coordinates, as in trajectories: the centre of the footprint, on the ground.
#pragma once
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/error.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// A vehicle that is present at an instant.
struct LivePose {
  std::string id;    // the caller's own id, unique in a frame; the same vehicle keeps it
  std::string type;  // type of a [[live_vehicle]]; must not change while the vehicle stays
  glm::dvec3 position_m{0};
  glm::dquat orientation{1, 0, 0, 0};  // w, x, y, z: from the vehicle (x ahead, y left, z up) to the scene; unit
  // Not given: computed from the last two poses. It is 0 if there is no earlier pose, if time did not go forward, or if
  // the vehicle would have been faster than 150 m/s, which counts as a jump.
  std::optional<glm::dvec3> velocity_m_s, angular_velocity_rad_s;  // scene axes
  // The way that the vehicle has gone ahead, by which its wheels and limbs turn ([[target_part]]), from a start of the
  // caller's. Not given: counted from the frames that were sent, from the first one with the vehicle on.
  std::optional<double> travelled_m = {};
};

// A vehicle that cannot be placed. Nothing has changed when this is thrown.
struct PoseError : InputError {
  // unknown_type, type_changed, no_place, duplicate_id, out_of_bounds, out_of_time, bad_value
  std::string code;
  PoseError(std::string error_code, const std::string& message) : InputError(message), code(std::move(error_code)) {}
};

// The box in which poses are accepted, both ends included; file coordinates.
struct LiveBounds {
  glm::dvec3 lower_m{0}, upper_m{0};
};

// One [[live_vehicle]].
struct LiveType {
  std::string name;
  double length_m = 0, width_m = 0, height_m = 0;
  uint32_t first_place = 0, count = 0;
  std::vector<MountConfig> mounts;  // mounts that it carries
};

// The traffic of one source of poses: the place of each of its vehicles, and its poses in the last two frames. Several
// sources may use one Simulation in turn, each with its own traffic: in a frame all places belong to one source.
struct LiveTraffic {
  struct Vehicle {
    uint32_t place = 0;
    glm::dvec3 position_m{0};  // file coordinates
    glm::dquat orientation{1, 0, 0, 0};
    std::optional<glm::dvec3> velocity_m_s = {};  // given, or computed from two poses
    glm::dvec3 way_m{0}, turn_rad{0};             // integrals of its velocities along its own axes
  };
  using Vehicles = std::map<std::string, Vehicle, std::less<>>;  // by id
  Vehicles vehicles;                                             // vehicles of the last frame
  double time_s = 0;                                             // time of the last frame
  uint32_t frames = 0;      // number of frames computed so far, which is the number of the next frame
  Vehicles earlier;         // vehicles of the frame before the last one
  double earlier_s = 0;     // time of the frame before the last one
  DiscoveryMark discovery;  // see trace.discover_every_s
};

// The names of the ends and vehicles of a frame that the sender of its poses uses. Absent ends have empty names.
struct LiveNames {
  std::vector<std::string> transmitters, receivers;  // VEHICLE/MOUNT, or the name of a fixed end
  std::vector<std::string> instances;                // vehicle ids
};

struct LiveFrame : LiveNames {
  FrameResult result;
};

}  // namespace wavetracer
