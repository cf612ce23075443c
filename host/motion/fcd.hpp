// SUMO's floating car data: XML, one <timestep> after the other, each with its vehicles, persons and containers.
// Assumes what read.hpp says of FCD files; holds one chunk of the file and the samples, never the document.
#pragma once
#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

Trajectories read_fcd(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
