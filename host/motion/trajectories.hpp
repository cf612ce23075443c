// SPDX-License-Identifier: Apache-2.0
// The motion of vehicles: tracks of samples in scene coordinates, grouped by vehicle type.
// Yaw is counter-clockwise from +x, pitch is positive nose up; a vehicle looks along +x of its own frame, z is up.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

namespace wavetracer {

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

struct VehicleType {
  std::string name;  // the name in the trajectory file
  double length_m, width_m, height_m;
  bool operator==(const VehicleType&) const = default;
};

// The state of a vehicle at one time. Readers set values that their file lacks to not_given; every Sample of a finished
// Trajectories is complete.
struct Sample {
  double time_s = 0;
  glm::dvec3 position_m{0};  // centre of the footprint, on the ground
  double yaw_rad = not_given, pitch_rad = not_given;
  double speed_m_s = not_given;        // along the heading, negative in reverse
  glm::dvec3 velocity_m_s{not_given};  // derivative of position_m at time_s
};

struct Track {
  std::string id;
  uint32_t type = 0;               // index into Trajectories::types
  std::vector<Sample> samples;     // in order of strictly increasing time
  std::vector<uint32_t> segments;  // first sample of each segment; between segments the vehicle is absent
  bool mounts = true;              // true if [[mount]] entries put antennas on it
};

struct Trajectories {
  std::vector<VehicleType> types;
  std::vector<Track> tracks;                 // sorted by the time of the first sample, then by id
  double first_time_s = 0, last_time_s = 0;  // over all samples
  double step_s = 0;                         // median time between samples of a vehicle; 0 if no vehicle has two
  std::vector<std::string> warnings;
};

}  // namespace wavetracer
