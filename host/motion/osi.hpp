// Traces of the ASAM Open Simulation Interface (.osi): GroundTruth or SensorView messages of version 3, each after its
// length as four bytes, the lowest first. Plain or gzip.
//
// Moving objects are vehicles, called by the numbers of their ids, or as they were called in the run that
// `wavetracer convert --to osi` wrote. Their positions are the middles of their bounding boxes; sizes are those of the
// objects. A positive pitch is nose down there; roll is left out.
#pragma once
#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

// How such a trace begins.
bool is_osi_trace(std::string_view start);

Trajectories read_osi(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
