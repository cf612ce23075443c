// Tracks of GPS receivers: GPX 1.0 and 1.1.
#pragma once
#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

// Every <trk> is a vehicle, called by its <name>; times are seconds after the earliest point of the file. Throws
// InputError.
Trajectories read_gpx(ByteStream& stream, const TrajectoryOptions& options);

// Seconds since 1970 of a time of XML Schema (ISO 8601), "2026-11-24T10:00:00.25Z"; without a zone it is UTC. Empty
// where the text is none.
std::optional<double> utc_seconds(std::string_view text);

}  // namespace wavetracer
