// SPDX-License-Identifier: Apache-2.0
// The readers of trajectory files, one for each format, of which read.hpp chooses one. Each holds one chunk of the file
// and the samples, never the document. All throw InputError with file, line and what to do; files may be plain or
// packed by gzip.
#pragma once
#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>

#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

// Reads traces of the ASAM Open Simulation Interface (.osi): GroundTruth or SensorView messages of version 3, each
// after its length as four bytes, the lowest first. Plain or gzip.
//
// Moving objects are vehicles, named by the numbers of their ids, or by their names in the run if `wavetracer convert
// --to osi` wrote the trace. Their positions are the middles of their bounding boxes; sizes are those of the objects.
// In OSI a positive pitch is nose down; roll is ignored.
Trajectories read_osi(ByteStream& stream, const TrajectoryOptions& options);
// Tells whether a file begins like such a trace.
bool is_osi_trace(std::string_view start);

// Reads SUMO's floating car data: XML, one <timestep> after the other, each with its vehicles, persons and containers;
// or CSV, a row for each of them, as SUMO's xml2csv.py and newer releases of SUMO write it. See read.hpp for the
// format.
Trajectories read_fcd(ByteStream& stream, const TrajectoryOptions& options);
Trajectories read_fcd_csv(ByteStream& stream, const TrajectoryOptions& options);
// Tells whether a text begins with the header of SUMO's CSV: columns "timestep_time", "vehicle_id" and so on; or
// "time", "id", "x", "y" separated by semicolons, and one that only SUMO has, such as "angle". Other CSV outputs of
// SUMO pass as well: the reader says which columns they lack.
bool is_fcd_csv(std::string_view text);

// Reads tracks of GPS receivers: GPX 1.0 and 1.1. Every <trk> becomes a vehicle, named by its <name>; times are seconds
// after the earliest point of the file.
Trajectories read_gpx(ByteStream& stream, const TrajectoryOptions& options);

// A time since 1970. Whole seconds and the rest are separate, as one double holds today's times to 0.24 us only.
struct UtcTime {
  int64_t whole_s = 0;
  double rest_s = 0;  // below 1
  auto operator<=>(const UtcTime&) const = default;
  double since_s(const UtcTime& other) const {
    return static_cast<double>(whole_s - other.whole_s) + (rest_s - other.rest_s);
  }
};

// Parses a time of XML Schema (ISO 8601), such as "2026-11-24T10:00:00.25Z"; without a zone it is UTC. Returns nothing
// for other text.
std::optional<UtcTime> utc_time(std::string_view text);

// Reads recordings of CARLA: the file that its server writes (client.start_recorder), or its text, which
// client.show_recorder_file_info(file, show_all=True) returns.
// Lengths in both are Unreal's: centimetres, y to the right; angles in degrees. Sizes are in them only if the recording
// was started with additional_data=True. The text has six digits of each number, the file all.
Trajectories read_carla_recorder_file(ByteStream& stream, const TrajectoryOptions& options);
Trajectories read_carla(ByteStream& stream, const TrajectoryOptions& options);
// Tell whether a file begins like these.
bool is_carla_recorder_file(std::string_view start);
bool is_carla_recording(std::string_view start);

// Reads trajectories that esmini writes: its CSV log (--csv_logger) and its recording as text (dat2csv).
// Both give positions of OpenSCENARIO's reference point, the middle of the rear axle on the ground. The log says where
// the bounding box is relative to it; the recording does not. Angles are right-handed: a positive pitch is nose down.
Trajectories read_esmini_log(ByteStream& stream, const TrajectoryOptions& options);
Trajectories read_esmini_recording(ByteStream& stream, const TrajectoryOptions& options);
// Tell whether a file begins like these.
bool is_esmini_log(std::string_view start);
bool is_esmini_recording(std::string_view start);

// Reads trajectories as comma-separated values with a header that names the columns (RFC 4180, no line breaks in
// quotes). See read.hpp for the columns.
Trajectories read_csv(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
