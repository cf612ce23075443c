// SPDX-License-Identifier: Apache-2.0
// Reads trajectories as comma-separated values with a header that names the columns (RFC 4180, no line breaks in
// quotes). See read.hpp for the columns; it holds one chunk of the file, one line, and the samples.
#pragma once
#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

Trajectories read_csv(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
