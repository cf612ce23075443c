// SPDX-License-Identifier: Apache-2.0
// Reads tracks of GPS receivers: GPX 1.0 and 1.1.
#pragma once
#include <compare>
#include <cstdint>

#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

// Every <trk> becomes a vehicle, named by its <name>; times are seconds after the earliest point of the file. Throws
// InputError.
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

}  // namespace wavetracer
