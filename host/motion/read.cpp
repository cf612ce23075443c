// Which reader a file needs, by its first bytes.
// Assumes that XML begins with '<' after blanks and a byte order mark, and that no CSV file does.
#include "motion/read.hpp"

#include <fmt/format.h>

#include "motion/byte_stream.hpp"
#include "motion/csv.hpp"
#include "motion/fcd.hpp"
#include "motion/gpx.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Trajectories read_trajectories(const std::filesystem::path& path, const TrajectoryOptions& options) {
  ByteStream stream(path);
  const std::string_view start = stream.peek();
  // Blanks, the byte order marks of UTF-8 and UTF-16, and the zero bytes of UTF-16, which expat reads.
  constexpr std::string_view passed_over(" \t\r\n\xEF\xBB\xBF\xFF\xFE\0", 10);
  const size_t first = start.find_first_not_of(passed_over);
  if (first == start.npos) {
    throw InputError(
        fmt::format("{}: the file is empty; a trajectory file is the FCD output of SUMO, GPX or CSV", stream.file()));
  }
  if (start[first] == '<') {
    const size_t gpx = start.find("<gpx");  // comments and instructions may come before
    return gpx < start.find("<fcd-export") ? read_gpx(stream, options) : read_fcd(stream, options);
  }
  if (start.substr(0, first).find_first_of("\xFF\xFE") != start.npos) {
    throw InputError(fmt::format("{}: this is a text file in UTF-16; save it as UTF-8", stream.file()));
  }
  return read_csv(stream, options);
}

}  // namespace wavetracer
