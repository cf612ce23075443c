// waypoints.h5: one table, /waypoints, a row a waypoint.
// Kinds are the numbers of WaypointKind; positions are those of the scene file.
#include "output/waypoints_h5.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "wavetracer/error.hpp"
#include "wavetracer/waypoints.hpp"

namespace wavetracer {
namespace {

using hdf5::Meaning;
using hdf5::Rows;

bool is_rectangular(const WaypointRows& rows) {
  const size_t count = rows.size();
  return rows.frame.size() == count && rows.sample.size() == count && rows.depth.size() == count &&
         rows.kind.size() == count && rows.position_m.size() == count && rows.surface.size() == count &&
         rows.instance.size() == count;
}

}  // namespace

void encode_waypoints_head_h5(const Run& run, hdf5::File& file) {
  const auto text = [&](const char* name, const std::string& value) { hdf5::write_attribute(file.id(), name, value); };
  text("format", "wavetracer waypoints");
  hdf5::write_attribute(file.id(), "format_version", uint32_t{1});
  text("version", run.summary.version);
  text("command_line", run.summary.command_line);
  text("config_file", run.config.file);
  text("config", run.config.text);
  text("scene_file", run.scene.file);
  text("convention_coordinates", "right-handed, z up, metres, those of the scene file after its scale and up axis");
}

void encode_waypoints_frames_h5(Frames frames, hdf5::File& file) {
  hsize_t count = 0;
  for (const FrameResult& frame : frames) {
    if (!is_rectangular(frame.waypoints))
      throw RuntimeError(fmt::format("the waypoints of frame {} have columns of unequal length; this is a fault of "
                                     "wavetracer, report it",
                                     frame.frame));
    count += frame.waypoints.size();
  }
  const auto group = file.make_group(
      "/waypoints", "one row a waypoint of a sampled ray, sorted by frame, tx, sample, depth; hits of a segment, by "
                    "receiver, come before its end");
  const auto column = [&](const char* name, const char* description, auto member) {
    using Value = typename std::remove_cvref_t<decltype(std::declval<WaypointRows>().*member)>::value_type;
    Rows<Value> table(file, std::string("/waypoints/") + name, {"1", description}, {count});
    for (const FrameResult& frame : frames) table.append(frame.waypoints.*member);
  };
  column("frame", "number of the frame, see /frames/frame of paths.h5", &WaypointRows::frame);
  column("tx", "row of /transmitters of paths.h5", &WaypointRows::tx);
  column("sample", "launch index of the ray, counted for its transmitter", &WaypointRows::sample);
  column("depth", "segments of the ray up to here, 0 at the transmitter", &WaypointRows::depth);
  Rows<uint8_t> kinds(file, "/waypoints/kind",
                      {"1", "0 launch, 1 reflection, 2 diffraction, 3 hit (a receiver, trace.reception = \"sphere\"), "
                            "4 miss (the ray met nothing more)"},
                      {count});
  static_assert(sizeof(WaypointKind) == sizeof(uint8_t) && sizeof(glm::dvec3) == 3 * sizeof(double));
  for (const FrameResult& frame : frames)
    kinds.append({reinterpret_cast<const uint8_t*>(frame.waypoints.kind.data()), frame.waypoints.size()});
  Rows<double> positions(file, "/waypoints/position_m",
                         {"m", "position in the coordinates of the scene file, (x, y, z); of a hit the receiver's "
                               "centre, of a miss a point 1 m along the segment that met nothing"},
                         {count, 3});
  for (const FrameResult& frame : frames)
    positions.append(
        {reinterpret_cast<const double*>(frame.waypoints.position_m.data()), 3 * frame.waypoints.size()});
  column("surface",
         "of a reflection the surface of the scene, or of the model of the instance that was hit, as in /vertices of "
         "paths.h5; of a hit the row of /receivers there; 4294967295 elsewhere",
         &WaypointRows::surface);
  column("instance", "row of /instances of paths.h5, the vehicle that was hit; 4294967295 for the static scene",
         &WaypointRows::instance);
}

void encode_waypoints_h5(const Run& run, Frames frames, hdf5::File& file) {
  encode_waypoints_head_h5(run, file);
  encode_waypoints_frames_h5(frames, file);
}

}  // namespace wavetracer
