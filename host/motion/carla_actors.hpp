// SPDX-License-Identifier: Apache-2.0
// The actors of a recording of CARLA and their places, which both of its forms have: they become tracks at the end.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motion/track_builder.hpp"

namespace wavetracer {

struct CarlaActor {
  std::string blueprint, base_type, role;  // "vehicle.tesla.model3", "car", "hero"
  bool two_wheels = false;
  std::optional<glm::dvec3> box_centre_m, box_half_m;  // relative to its location: ahead, left, up

  bool moves() const { return blueprint.starts_with("vehicle.") || blueprint.starts_with("walker."); }
  // Takes an attribute of its description; others than the three that count are skipped.
  void attribute(std::string_view key, std::string_view value);
  // centre: from its location, half: half of the size, both in Unreal's axes and centimetres.
  void box(const glm::dvec3& centre, const glm::dvec3& half);
};

// The place of an actor, in CARLA's units: centimetres, y to the right, degrees.
struct CarlaSample {
  uint64_t actor, line;  // line: the line or frame of the file, for messages
  double time_s;
  glm::dvec3 location, rotation;  // roll, pitch, yaw
};

class CarlaTracks {
 public:
  // The options must outlive it.
  CarlaTracks(std::string file, const TrajectoryOptions& options) : tracks_(std::move(file), options) {}

  // An actor keeps its number; one that is made again has nothing of the one before it.
  CarlaActor& create(uint64_t number, std::string blueprint);
  // Returns null if there is no such actor, or if it is neither a vehicle nor a person.
  CarlaActor* moving(uint64_t number);
  // Must be called for each frame, with its time, which is later than those before.
  void begin_frame(double time_s) { tracks_.add_frame(time_s); }
  void add(const CarlaSample& sample) { samples_.push_back(sample); }
  void warn(std::string message) { tracks_.warn(std::move(message)); }
  // no_samples: what to do if there are no places of vehicles.
  Trajectories finish(std::string_view no_samples);

 private:
  void place(const CarlaSample& from, bool one_hero);

  TrackBuilder tracks_;
  std::map<uint64_t, CarlaActor> actors_;
  std::vector<CarlaSample> samples_;
  uint64_t unsized_ = 0;
};

}  // namespace wavetracer
