// SPDX-License-Identifier: Apache-2.0
// Trajectories from files (SUMO FCD, GPX, CSV, OSI, esmini, CARLA) and from waypoints, complete and in a fixed order.
// Throws InputError with file, line and what to do; Trajectories::warnings says what was left out or assumed.
#pragma once
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motion/trajectories.hpp"

namespace wavetracer {

// Returns the z of the ground at a place, both in coordinates of the scene file; nothing where there is no ground.
using GroundHeight = std::function<std::optional<double>(const glm::dvec2&)>;

struct TrajectoryOptions {
  // Scene coordinate = scale * file coordinate + offset_m. SUMO's network coordinates are those of its projection plus
  // the netOffset of <location>: a scene in the projection's coordinates needs offset_m = -netOffset. Sizes and speeds
  // are in metres already and are not scaled.
  glm::dvec3 offset_m{0};
  double scale = 1;
  // FCD: whether <person> and <container> are read like vehicles, with "person:" and "container:" before their ids,
  // since SUMO numbers them separately. Riders inside of a <vehicle> are never read, since the vehicle carries them.
  bool persons = false, containers = false;
  std::vector<VehicleType> types = {};  // sizes by name of the type; they take precedence over those of SUMO's classes
  // Size of types that neither `types` nor SUMO's classes name. If absent, such a type is an error.
  std::optional<VehicleType> default_type = VehicleType{"", 5.0, 1.8, 1.5};
  // The largest speed of a vehicle without a reported speed between two samples; a longer move is a jump.
  double max_speed_m_s = 100;
  // Converts (longitude, latitude) in degrees to scene coordinates; without it a file in degrees is an error.
  std::function<glm::dvec2(const glm::dvec2&)> from_degrees = {};
  // Heights are above the ground; those of files in degrees always are, if there is a ground.
  bool above_ground = false;
  GroundHeight ground = {};
};

// Reads FCD (`.xml`), GPX, CSV, traces of OSI, or recordings of esmini or CARLA (readers.hpp), plain or gzip; the
// content decides which format it is.
//
// FCD, as SUMO writes it with --fcd-output: time, id, x, y are needed; angle, speed, z, slope and type are used where
// they are, other attributes are not. angle is in degrees clockwise from north; (x, y, z) is the centre of the front
// bumper, from which the centre of the vehicle follows by its length. Coordinates may be degrees (--fcd-output.geo); z
// is then above the ground where the file has none. FCD as CSV, as SUMO and its xml2csv.py write it, with columns such
// as timestep_time, vehicle_id and person_x, is read as well.
//
// CSV: a header names the columns, in any order: time (s), id, x, y (m) are needed; z (m), yaw (degrees
// counter-clockwise from +x), speed (m/s) and type are optional, also cell by cell. (x, y, z) is the centre of the
// footprint. Rows may be sorted by time or by vehicle. Lines that begin with # are comments. lat and lon (or latitude
// and longitude, degrees) may stand in the place of x and y; z is then above the ground.
//
// GPX: tracks with times, in degrees; see motion/readers.hpp.
//
// A missing heading is the direction of motion, and is kept while the vehicle stands. A track is cut into segments at
// gaps and jumps. A gap is longer than 1.5 steps; in recordings of CARLA and esmini, whose steps vary, it is a frame
// without the vehicle. A jump is farther than this: 1.5 times the higher speed of both ends times the time t, plus 5 m
// (a change of lanes in one step), plus 5 m/s^2 t^2 (braking and starting).
Trajectories read_trajectories(const std::filesystem::path& path, const TrajectoryOptions& options = {});

struct Waypoint {
  double time_s;
  glm::dvec3 position_m;
};

struct WaypointTrack {
  std::string id;
  VehicleType type;
  std::vector<Waypoint> waypoints;
  bool above_ground = false;  // heights are above the ground, which the vehicle follows
};

// Connects waypoints in scene coordinates smoothly, however far apart they are: each track has one segment. Two equal
// positions in a row are a stop.
Trajectories connect_waypoints(std::span<const WaypointTrack> tracks, const GroundHeight& ground = {});

}  // namespace wavetracer
