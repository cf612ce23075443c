// SPDX-License-Identifier: Apache-2.0
#include "calibration/end_places.hpp"
#include <algorithm>
#include <array>
#include <utility>
#include "radio/antenna.hpp"

namespace wavetracer::calibration {
namespace {

double& slot_of(EndPlaces& places, uint32_t tx, Property property) {
  if (tx == no_end) return places.receivers_rise_m;
  TransmitterPlace& place = places.transmitters[tx];
  switch (property) {
    case Property::x:
      return place.position_m.x;
    case Property::y:
      return place.position_m.y;
    case Property::yaw:
      return place.yaw_pitch_roll_deg.x;
    case Property::pitch:
      return place.yaw_pitch_roll_deg.y;
    case Property::roll:
      return place.yaw_pitch_roll_deg.z;
    default:
      return place.position_m.z;
  }
}

}  // namespace

bool EndPlaces::same_points(const EndPlaces& other) const {
  return receivers_rise_m == other.receivers_rise_m &&
         std::ranges::equal(transmitters, other.transmitters, {}, &TransmitterPlace::position_m,
                            &TransmitterPlace::position_m);
}

EndPlaces end_places(const std::vector<RadioEnd>& transmitters) {
  const auto vector = [](const std::array<double, 3>& of) { return glm::dvec3(of[0], of[1], of[2]); };
  EndPlaces out;
  for (const RadioEnd& end : transmitters)
    out.transmitters.push_back({end.name, vector(end.position_m), vector(end.orientation_deg)});
  return out;
}

double value_of(EndPlaces places, uint32_t tx, Property property) { return slot_of(places, tx, property); }

EndPlaces with_parameters(EndPlaces places, std::span<const Parameter> parameters, std::span<const double> theta) {
  for (size_t i = 0; i < parameters.size(); ++i)
    if (is_of_end(parameters[i].property) && theta[i] != 0)
      slot_of(places, parameters[i].transmitter, parameters[i].property) = parameters[i].value(theta[i]);
  return places;
}

void place_ends(const EndPlaces& places, const glm::dvec3& origin_m, WorldState& state) {
  std::vector<EndState>& transmitters = state.transmitters.edit();
  for (size_t tx = 0; tx < transmitters.size(); ++tx) {
    const TransmitterPlace& place = places.transmitters[tx];
    const glm::dvec3& turn = place.yaw_pitch_roll_deg;
    transmitters[tx].position_m = place.position_m - origin_m;
    transmitters[tx].rotation = rotation_of({turn.x, turn.y, turn.z});
  }
  if (places.receivers_rise_m != 0)
    for (EndState& end : state.receivers.edit()) end.position_m.z += places.receivers_rise_m;
}

}  // namespace wavetracer::calibration
