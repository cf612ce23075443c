// SPDX-License-Identifier: Apache-2.0
// The places and orientations of the ends of measured links, as far as they are fitted.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>
#include "calibration/parameters.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer::calibration {

struct TransmitterPlace {
  std::string name;
  glm::dvec3 position_m{0};          // file coordinates of the scene
  glm::dvec3 yaw_pitch_roll_deg{0};  // as orientation_deg of [[transmitter]]
  bool operator==(const TransmitterPlace&) const = default;
};

struct EndPlaces {
  std::vector<TransmitterPlace> transmitters;
  double receivers_rise_m = 0;  // all measured places are so much higher than the files say
  // Are all ends at the same points? They may be turned.
  bool same_points(const EndPlaces& other) const;
  bool operator==(const EndPlaces&) const = default;
};

// The places of these transmitters, whose positions are in file coordinates.
EndPlaces end_places(const std::vector<RadioEnd>& transmitters);

// Returns the value of a property of transmitter `tx` in its unit, or that of all receivers (no_end).
double value_of(EndPlaces places, uint32_t tx, Property property);

// Returns the places with the parameters of ends at these values of theta.
EndPlaces with_parameters(EndPlaces places, std::span<const Parameter> parameters, std::span<const double> theta);

// Moves the ends of a world at rest to these places. origin_m: that of recentred coordinates.
void place_ends(const EndPlaces& places, const glm::dvec3& origin_m, WorldState& state);

}  // namespace wavetracer::calibration
