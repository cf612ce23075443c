// SPDX-License-Identifier: Apache-2.0
// Reads recordings of CARLA as text, which client.show_recorder_file_info(file, show_all=True) returns.
// Lengths in it are Unreal's: centimetres, y to the right; angles in degrees. Sizes are in it only if the recording was
// started with additional_data=True.
#pragma once
#include "motion/byte_stream.hpp"
#include "motion/read.hpp"

namespace wavetracer {

// Tells whether a text begins like such a recording.
bool is_carla_recording(std::string_view start);

Trajectories read_carla(ByteStream& stream, const TrajectoryOptions& options);

}  // namespace wavetracer
