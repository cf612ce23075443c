// Tracks of GPS receivers: GPX 1.0 and 1.1.
#pragma once
#include <compare>
#include <cstdint>

#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

// Every <trk> is a vehicle, called by its <name>; times are seconds after the earliest point of the file. Throws
// InputError.
Trajectories read_gpx(ByteStream& stream, const TrajectoryOptions& options);

// Since 1970. Whole seconds and the rest apart, as one double keeps today's times to 0.24 us only.
struct UtcTime {
  int64_t whole_s = 0;
  double rest_s = 0;  // below 1
  auto operator<=>(const UtcTime&) const = default;
  double since_s(const UtcTime& other) const {
    return static_cast<double>(whole_s - other.whole_s) + (rest_s - other.rest_s);
  }
};

// A time of XML Schema (ISO 8601), "2026-11-24T10:00:00.25Z"; without a zone it is UTC. Empty where the text is none.
std::optional<UtcTime> utc_time(std::string_view text);

}  // namespace wavetracer
