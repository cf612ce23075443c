// SPDX-License-Identifier: Apache-2.0
// The radio ends of a world: those that stand, those that ride on vehicles, and which of them are one antenna.
#pragma once
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "scene/ground.hpp"
#include "simulation/place_finder.hpp"
#include "simulation/world_fleet.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

inline glm::dvec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

struct MountedEnd {
  uint32_t track;
  glm::dvec3 offset_m;
  glm::dmat3 rotation;  // antenna axes to vehicle axes
  bool above_ground;    // offset_m.z is the height above the ground
};

// All ends of one role: those that stand, then those on vehicles.
struct EndsOfRole {
  SharedList<RadioEnd> ends;
  SharedList<EndState> standing;
  std::vector<MountedEnd> mounted;
};

struct WorldEnds {
  EndsOfRole transmitters, receivers;
};

// The ground below antennas whose height is measured from it, in recentred coordinates.
struct GroundBelow {
  std::shared_ptr<const Ground> ground;  // null where no [[mount]] asks for it
  glm::dvec3 origin_m{0};                // origin of the scene

  // The z of the ground at a place; empty where there is none. Needs `ground`.
  std::optional<double> height_m(const glm::dvec3& place_m) const;
};
GroundBelow ground_below(const std::vector<MountConfig>& mounts, PlaceFinder& places, const glm::dvec3& origin_m);

// A role whose ends all stand. origin_m: of the recentred scene.
EndsOfRole standing_ends(SharedList<RadioEnd> ends, const glm::dvec3& origin_m);

// These ends and those that [[mount]]s put on vehicles, by track, then by mount. by_id: patterns may name vehicles, not
// only types; places of a live world have no ids that a user would know. Throws ConfigError for a pattern that nothing
// has, a name that is taken, and a node that a body lacks.
WorldEnds with_mounts(WorldEnds standing, const std::vector<MountConfig>& mounts, const Fleet& fleet,
                      const GroundBelow& ground, bool by_id);

// The ends of a role where the vehicles are in these states, one for each track.
SharedList<EndState> ends_at(const EndsOfRole& role, const Fleet& fleet, const GroundBelow& ground,
                             const std::vector<VehicleState>& vehicles);

// Each transmitter's receiver that is the same end, and each receiver's transmitter; no_end where there is none.
struct TwinEnds {
  std::vector<uint32_t> receiver_of_transmitter, transmitter_of_receiver;
};

// A transmitter and a receiver are one end where they stand in one place, or on one vehicle in one place.
TwinEnds find_twins(const WorldEnds& ends);

}  // namespace wavetracer
