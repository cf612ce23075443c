// SPDX-License-Identifier: Apache-2.0
// Writes waypoints.h5: one table, /waypoints, a row per waypoint.
// Kinds are the numbers of WaypointKind; positions are those of the scene file.
#include "output/waypoints_h5.hpp"
#include <fmt/format.h>
#include <map>
#include "wavetracer/error.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer {
namespace {

bool is_rectangular(const WaypointRows& rows) {
  const size_t count = rows.size();
  return rows.frame.size() == count && rows.sample.size() == count && rows.depth.size() == count &&
         rows.kind.size() == count && rows.position_m.size() == count && rows.surface.size() == count &&
         rows.instance.size() == count && rows.source.size() == count;
}

// Explains the numbers of WaypointKind, in their order.
std::string kind_legend() {
  std::map<int, std::string_view> interactions;
  for (const InteractionKind& kind : interaction_kinds)
    if (kind.waypoint != WaypointKind::launch) interactions[static_cast<int>(kind.waypoint)] = kind.legend;
  std::string legend = "0 launch";
  for (const auto& [number, word] : interactions) legend += fmt::format(", {} {}", number, word);
  return legend + ", 3 hit (a receiver, trace.reception = \"sphere\"), 4 miss (the ray met nothing more)";
}

}  // namespace

void encode_waypoints_head_h5(const Run& run, hdf5::File& file) {
  const auto text = [&](const char* name, const std::string& value) { hdf5::write_attribute(file.id(), name, value); };
  text("format", "wavetracer waypoints");
  hdf5::write_attribute(file.id(), "format_version", uint32_t{2});
  text("version", run.summary.version);
  text("config_file", run.config.file);
  text("config", run.config.text);
  text("scene_file", run.scene.file);
  text("convention_coordinates", "right-handed, z up, metres, those of the scene file after its scale and up axis");
}

void append_waypoints_h5(const Run&, const FrameResult& frame, FrameTables& tables) {
  const WaypointRows& rows = frame.waypoints;
  if (!is_rectangular(rows))
    throw RuntimeError(
        fmt::format("the waypoints of frame {} have columns of unequal length; this is a fault of wavetracer, "
                    "report it",
                    frame.frame));
  tables.group("/waypoints",
               "one row per waypoint of a sampled ray, sorted by frame, tx, sample, depth; hits of a segment, "
               "by receiver, come before its end");
  const auto column = [&](const char* name, const char* description, const auto& values) {
    tables.append(name, {"1", description}, std::span(values));
  };
  column("frame", "number of the frame, see /frames/frame of paths.h5", rows.frame);
  column("tx", "row of /transmitters of paths.h5", rows.tx);
  column("sample", "launch index of the ray, counted for its transmitter", rows.sample);
  column("depth", "segments of the ray up to here, 0 at the transmitter", rows.depth);
  static_assert(sizeof(WaypointKind) == sizeof(uint8_t) && sizeof(glm::dvec3) == 3 * sizeof(double));
  tables.append<uint8_t>("kind", {"1", kind_legend().c_str()},
                         {reinterpret_cast<const uint8_t*>(rows.kind.data()), rows.size()});
  tables.append<double>("position_m",
                        {"m",
                         "position in the coordinates of the scene file, (x, y, z); "
                         "of a hit the receiver's centre, of a miss a point 1 m along the segment that met nothing"},
                        {reinterpret_cast<const double*>(rows.position_m.data()), 3 * rows.size()}, {3});
  column("surface",
         "of a reflection the surface of the scene, or of the model of the instance that was hit, "
         "as in /vertices of paths.h5; of a hit the row of /receivers there; 4294967295 elsewhere",
         rows.surface);
  static_assert(sizeof(WaypointSource) == sizeof(uint8_t));
  tables.append<uint8_t>("source",
                         {"1",
                          "who found where the segment before the waypoint ends: 0 launch (there is none), "
                          "1 traced, 2 the ray cache, 3 not known (the segment after the last interaction)"},
                         {reinterpret_cast<const uint8_t*>(rows.source.data()), rows.size()});
  column("instance", "row of /instances of paths.h5, the vehicle that was hit; 4294967295 for the static scene",
         rows.instance);
}

}  // namespace wavetracer
