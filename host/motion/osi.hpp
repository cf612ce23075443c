// SPDX-License-Identifier: Apache-2.0
// Reads traces of the ASAM Open Simulation Interface (.osi): GroundTruth or SensorView messages of version 3, each
// after its length as four bytes, the lowest first. Plain or gzip.
//
// Moving objects are vehicles, named by the numbers of their ids, or by their names in the run if `wavetracer convert
// --to osi` wrote the trace. Their positions are the middles of their bounding boxes; sizes are those of the objects.
// In OSI a positive pitch is nose down; roll is ignored.
#pragma once
#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

// Tells whether a file begins like such a trace.
bool is_osi_trace(std::string_view start);

Trajectories read_osi(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
