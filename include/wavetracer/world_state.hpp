// SPDX-License-Identifier: Apache-2.0
// The moving part of a world at one instant: vehicles as instances of models, and radio ends.
// Positions are recentred as the scene is (file coordinate = Scene::origin_m + position), in double.
#pragma once
#include <compare>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/paths.hpp"
#include "wavetracer/shared_list.hpp"

namespace wavetracer {

// A placed model: p in the coordinates of the model's Scene is at position_m + rotation * p, and moves with
// velocity_m_s + cross(angular_velocity_rad_s, rotation * p).
struct Placement {
  glm::dvec3 position_m{0};
  glm::dmat3 rotation{1.0};
  glm::dvec3 velocity_m_s{0};
  glm::dvec3 angular_velocity_rad_s{0};  // scene axes
  bool present = true;
};

struct EndState {
  glm::dvec3 position_m{0};
  glm::dmat3 rotation{1.0};  // antenna axes to scene axes
  glm::dvec3 velocity_m_s{0};
  uint32_t instance = no_instance;  // the vehicle that carries it, which does not block its paths
  bool present = true;
};

constexpr uint32_t no_target_surface = 0xFFFFFFFFu;

// A point of a target of sensing.
struct TargetState {
  glm::dvec3 position_m{0};
  glm::dmat3 rotation{1.0};  // axes of the target to scene axes
  glm::dvec3 velocity_m_s{0};
  uint32_t instance = no_instance;  // the vehicle that it belongs to, which hides nothing from it
  uint32_t law = 0;                 // its radar cross section: a law of FieldTables
  bool present = true;
  // A piece of the vehicle's body: its surface in the world, and the sides of the surface that are lit. All other parts
  // of the body may hide it.
  uint32_t surface = no_target_surface;
  bool lit_above = false, lit_below = false;
};

constexpr uint32_t no_end = 0xFFFFFFFFu;

// A transmitter and a receiver between which paths are computed.
struct Link {
  uint32_t tx, rx;
  auto operator<=>(const Link&) const = default;
};

struct WorldState {
  double time_s = 0;
  std::vector<Placement> instances;
  std::vector<TargetState> targets;  // points of all targets
  SharedList<EndState> transmitters, receivers;
  std::vector<Link> links;  // links of ends that are present, sorted, each once
  bool arrivals = false;    // in a live world: a vehicle has arrived, or jumped, since the previous frame
};

// The last frame of a source of poses that launched rays.
struct DiscoveryMark {
  std::optional<double> time_s;
  std::vector<bool>
      active;  // for the vehicles, then the transmitters: whether they were present, and whether they sent
};

// A target of sensing: its name, VEHICLE/MODEL on a vehicle, its [[target_model]], and the body of its vehicle.
struct SensedTarget {
  std::string name, model;
  uint32_t instance = no_instance;
};

// The properties of an instance that do not change with time.
struct Instance {
  std::string id, type;  // id and type of the vehicle, as in its trajectory
  uint32_t model = 0;    // index into the models of the world
  // Its surfaces and wedges are those of its model, numbered from here on; those of the static scene come first.
  uint32_t first_surface = 0;
  uint32_t first_wedge = 0;
};

}  // namespace wavetracer
