// SPDX-License-Identifier: Apache-2.0
// Measures placing instances anew in every frame, with the tree over them built on the host and on the device. The
// machine must be quiet.
#pragma once
#include <cstddef>
#include <string>

namespace wavetracer::bench {

// Prints a line for each of 100 to 10,000 cars: a frame's placement with its transfers, with the tree built on the
// device; the baseline is the same with the host's tree. The number of cars at which both are equal is the constant of
// simulation/placement.hpp.
void print_top_level_times(const std::string& device, size_t runs, const std::string& command);

}  // namespace wavetracer::bench
