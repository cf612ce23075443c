// SPDX-License-Identifier: Apache-2.0
// Reads SUMO's floating car data: XML, one <timestep> after the other, each with its vehicles, persons and containers;
// or CSV, a row for each of them, as SUMO's xml2csv.py and newer releases of SUMO write it. See read.hpp for the
// format; it holds one chunk of the file and the samples, never the document.
#pragma once
#include <string_view>

#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

Trajectories read_fcd(ByteStream& stream, const TrajectoryOptions& options);

// Tells whether a text begins with the header of SUMO's CSV: columns "timestep_time", "vehicle_id" and so on; or
// "time", "id", "x", "y" separated by semicolons, and one that only SUMO has, such as "angle". Other CSV outputs of
// SUMO pass as well: the reader says which columns they lack.
bool is_fcd_csv(std::string_view text);
Trajectories read_fcd_csv(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
