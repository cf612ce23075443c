// SPDX-License-Identifier: Apache-2.0
// The vehicles of one client of VaN3Twin's protocol, which places them one by one and never says that one has left.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "live/van3twin_message.hpp"
#include "wavetracer/live.hpp"

namespace wavetracer::live::van3twin {

// The rule by which positions of clients become those of the scene.
struct Coordinates {
  glm::dvec3 offset_m{0};  // added to each position
  bool front = true;       // positions are those of the middle of the front bumper, as in SUMO; else of the vehicle
};

class Traffic {
 public:
  enum class Placed { yes, no_place, outside };

  // types, bounds: those of the simulation, which must outlive this object.
  Traffic(const std::vector<LiveType>& types, const LiveBounds& bounds, const Coordinates& coordinates);

  // Places a vehicle, or moves it. A new id takes a place of the first type that has a free one. A vehicle without a
  // place, or outside of the scene, is absent. A vehicle that has missed two whole rounds of updates has left: a round
  // ends when a vehicle is updated that was updated in it before.
  Placed update(const LocationUpdate& update);

  // True if a vehicle came, moved or left since the last call of poses().
  bool has_changed() const { return changed_; }
  // True if the present round has an update of every vehicle, so that the next update probably begins another one.
  bool round_is_whole() const;
  // The vehicles that are present.
  std::vector<LivePose> poses();
  // The names of the antennas by which a vehicle sends and receives, or "" if it is absent or has none.
  std::string transmitter(const std::string& id) const;
  std::string receiver(const std::string& id) const;
  size_t size() const { return vehicles_.size(); }

 private:
  struct Vehicle {
    size_t type = 0;
    uint64_t round = 0;
    LivePose pose;
  };

  std::string antenna(const std::string& id, bool sending) const;
  void begin_round();

  const std::vector<LiveType>& types_;
  const LiveBounds& bounds_;
  Coordinates coordinates_;
  std::map<std::string, Vehicle, std::less<>> vehicles_;
  std::vector<uint32_t> used_;  // places that are taken, by type
  uint64_t round_ = 0;
  bool changed_ = true;
};

}  // namespace wavetracer::live::van3twin
