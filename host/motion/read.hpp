// Trajectories from files (SUMO FCD, GPX, CSV, OSI, esmini, CARLA) and from waypoints, complete and in a fixed order.
// Throws InputError with file, line and what to do; what is left out or made up is told in Trajectories::warnings.
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

// The z of the ground at a place, both in coordinates of the scene file; empty where there is none.
using GroundHeight = std::function<std::optional<double>(const glm::dvec2&)>;

struct TrajectoryOptions {
  // Scene coordinate = scale * file coordinate + offset_m. SUMO's network coordinates are those of its projection plus
  // the netOffset of <location>: a scene in the projection's coordinates needs offset_m = -netOffset. Sizes and speeds
  // are in metres already and are not scaled.
  glm::dvec3 offset_m{0};
  double scale = 1;
  // FCD: <person> and <container> are read like vehicles, with "person:" and "container:" before their ids, since SUMO
  // numbers them apart. Riders, written inside of their <vehicle>, are never read: the vehicle carries them.
  bool persons = false, containers = false;
  std::vector<VehicleType> types = {};  // sizes by the name of the type; they go before those of SUMO's classes
  // For types that neither `types` nor SUMO's classes name. Absent: such a type is an error.
  std::optional<VehicleType> default_type = VehicleType{"", 5.0, 1.8, 1.5};
  // The speed that a vehicle without a reported one may have between two samples; farther is a teleport.
  double max_speed_m_s = 100;
  // (longitude, latitude) in degrees to scene coordinates; without it a file in degrees is an error.
  std::function<glm::dvec2(const glm::dvec2&)> from_degrees = {};
  // Heights are above the ground; those of files in degrees always are, where there is a ground.
  bool above_ground = false;
  GroundHeight ground = {};
};

// FCD (`.xml`), GPX, CSV, traces of OSI (osi.hpp), or what esmini (esmini.hpp) or CARLA (carla.hpp) recorded; plain or
// gzip, told apart by content.
//
// FCD, as SUMO writes it with --fcd-output: time, id, x, y are needed; angle, speed, z, slope and type are used where
// they are, other attributes are not. angle is in degrees clockwise from north; (x, y, z) is the centre of the front
// bumper, from which the centre of the vehicle follows by its length. Coordinates may be degrees (--fcd-output.geo); z
// is then above the ground where the file has none. The same as CSV, as SUMO and its xml2csv.py write it, with columns
// such as timestep_time, vehicle_id and person_x, is read as well.
//
// CSV: a header names the columns, in any order: time (s), id, x, y (m) are needed; z (m), yaw (degrees
// counter-clockwise from +x), speed (m/s) and type are optional, also cell by cell. (x, y, z) is the centre of the
// footprint. Rows may be sorted by time or by vehicle. Lines that begin with # are comments. lat and lon (or latitude
// and longitude, degrees) may stand in the place of x and y; z is then above the ground.
//
// GPX: tracks with times, in degrees; see motion/gpx.hpp.
//
// A heading that is not given is that of the motion, and stays while the vehicle stands. A track falls into segments
// where it has a gap of more than 1.5 steps or a jump farther than 1.5 times the higher speed of both ends allows,
// and 5 m (a change of lanes in one step) and 5 m/s^2 t^2 (braking and starting) on top.
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

// Waypoints in scene coordinates, smoothly connected however far apart they are: one segment a track. Two equal
// positions one after the other are a stop.
Trajectories connect_waypoints(std::span<const WaypointTrack> tracks, const GroundHeight& ground = {});

}  // namespace wavetracer
