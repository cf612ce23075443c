// The radio ends of a world: those that stand and those that ride on vehicles, and which of them are one antenna.
#pragma once
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

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
  std::vector<RadioEnd> ends;
  std::vector<EndState> standing;
  std::vector<MountedEnd> mounted;
};

// A role whose ends all stand. origin_m: of the recentred scene.
EndsOfRole standing_ends(const std::vector<RadioEnd>& ends, const glm::dvec3& origin_m);

// Each transmitter's receiver that is the same end, and each receiver's transmitter; no_end where there is none.
struct TwinEnds {
  std::vector<uint32_t> receiver_of_transmitter, transmitter_of_receiver;
};

// A transmitter and a receiver are one end where they stand in one place, or on one vehicle in one place.
TwinEnds find_twins(const EndsOfRole& transmitters, const EndsOfRole& receivers);

}  // namespace wavetracer
