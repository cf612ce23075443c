// SPDX-License-Identifier: Apache-2.0
// Reads trajectories that esmini writes: its CSV log (--csv_logger) and its recording as text (dat2csv).
// Both give positions of OpenSCENARIO's reference point, the middle of the rear axle on the ground. The log says where
// the bounding box is relative to it; the recording does not. Angles are right-handed: a positive pitch is nose down.
#pragma once
#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

// Tell whether a file begins like these.
bool is_esmini_log(std::string_view start);
bool is_esmini_recording(std::string_view start);

Trajectories read_esmini_log(ByteStream& stream, const TrajectoryOptions& options);
Trajectories read_esmini_recording(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
