// SUMO's floating car data: XML, one <timestep> after the other, each with its vehicles, persons and containers; or
// CSV, as SUMO's xml2csv.py and newer releases of SUMO write it, a row for each of them. Assumes what read.hpp says of
// FCD files; holds one chunk of the file and the samples, never the document.
#pragma once
#include <string_view>

#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

Trajectories read_fcd(ByteStream& stream, const TrajectoryOptions& options);

// Does a text begin with the header of SUMO's CSV: columns "timestep_time", "vehicle_id" and so on; or "time",
// "id", "x", "y" with semicolons between them and one that SUMO alone has, such as "angle". Other outputs of SUMO as
// CSV pass as well: the reader says which columns they lack.
bool is_fcd_csv(std::string_view text);
Trajectories read_fcd_csv(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
