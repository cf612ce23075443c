// SPDX-License-Identifier: Apache-2.0
// The inputs that have errors, and how large these are.
#pragma once
#include <array>
#include <cstddef>

namespace wavetracer::accuracy {

// The inputs, in the order of all tables.
enum class Input { position, height, permittivity, vehicles };
constexpr size_t input_count = 4;
constexpr std::array<const char*, input_count> input_names{"position", "height", "permittivity", "vehicles"};

// A flag for each input.
using Varied = std::array<bool, input_count>;

// Standard deviations of normal errors; an input with 0 is not varied.
struct InputErrors {
  double position_m = 2;      // error of each horizontal coordinate of each antenna that is not on a vehicle
  double height_m = 0.2;      // error of each antenna's height
  double permittivity = 0.1;  // error of the logarithm of (permittivity - 1) and of the conductivity, for each material
  double vehicles_m = 2;      // error of each horizontal coordinate of each vehicle with its antennas
};

}  // namespace wavetracer::accuracy
