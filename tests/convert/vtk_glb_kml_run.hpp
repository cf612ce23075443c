// SPDX-License-Identifier: Apache-2.0
// A run for the tests of the exports of geometry, made without a device: four frames of a small city, a car with an
// antenna that drives through all of them, a truck that is there in two, and names that XML must escape.
#pragma once
#include <filesystem>

namespace wavetracer::test {

constexpr uint32_t first_frame = 2, frame_count = 4, rows_of_last_frame = 1200;

// Writes it into the folder as `wavetracer run` does. Frame i of the run has 1 + 10 i paths with 0 to 3 interactions,
// the last one rows_of_last_frame; the first of each frame has no power.
void write_geometry_run(const std::filesystem::path& folder);

}  // namespace wavetracer::test
