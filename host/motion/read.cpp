// SPDX-License-Identifier: Apache-2.0
// Chooses the reader of a file by its first bytes.
// XML begins with '<' after blanks and a byte order mark, and CSV files do not.
#include "motion/read.hpp"

#include <fmt/format.h>

#include "motion/byte_stream.hpp"
#include "motion/readers.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Trajectories read_trajectories(const std::filesystem::path& path, const TrajectoryOptions& options) {
  ByteStream stream(path);
  const std::string_view start = stream.peek();
  // These bytes are skipped: blanks, the byte order marks of UTF-8 and UTF-16, and the zero bytes of UTF-16, which
  // expat reads.
  constexpr std::string_view passed_over(" \t\r\n\xEF\xBB\xBF\xFF\xFE\0", 10);
  if (is_carla_recorder_file(start)) return read_carla_recorder_file(stream, options);
  if (is_osi_trace(start)) return read_osi(stream, options);
  const size_t first = start.find_first_not_of(passed_over);
  if (first == start.npos) {
    throw InputError(
        fmt::format("{}: the file is empty; a trajectory file is the FCD output of SUMO, GPX, CSV, an OSI trace, "
                    "or what esmini or CARLA has recorded",
                    stream.file()));
  }
  if (start[first] == '<') {
    const size_t gpx = start.find("<gpx");  // comments and processing instructions may come first
    return gpx < start.find("<fcd-export") ? read_gpx(stream, options) : read_fcd(stream, options);
  }
  if (start.substr(0, first).find_first_of("\xFF\xFE") != start.npos) {
    throw InputError(fmt::format("{}: this is a text file in UTF-16; save it as UTF-8", stream.file()));
  }
  const std::string_view text = start.substr(first);
  if (text.starts_with("\x89MCAP")) {
    throw InputError(fmt::format(
        "{}: this is an MCAP file; a binary trace of OSI (.osi) is read, which ASAM's osi-utilities make of it",
        stream.file()));
  }
  if (text.starts_with("\xFD"
                       "7zXZ")) {
    throw InputError(fmt::format("{}: this file is packed by xz; unpack it, or pack it by gzip", stream.file()));
  }
  if (is_esmini_log(text)) return read_esmini_log(stream, options);
  if (is_carla_recording(text)) return read_carla(stream, options);
  if (is_esmini_recording(text)) return read_esmini_recording(stream, options);
  if (is_fcd_csv(text)) return read_fcd_csv(stream, options);
  return read_csv(stream, options);
}

}  // namespace wavetracer
