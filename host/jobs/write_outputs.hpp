// SPDX-License-Identifier: Apache-2.0
// Outputs of a frame that is needed no more.
#pragma once
#include <filesystem>
#include <vector>

#include "wavetracer/output.hpp"

namespace wavetracer {

// As write_outputs(). The memory of the frame is free before the head of paths.h5 is made, which has some 400 bytes for
// each end while it is copied.
std::vector<std::filesystem::path> write_frame(const std::filesystem::path& directory, const Run& run,
                                               FrameResult frame);

}  // namespace wavetracer
