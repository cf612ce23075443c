// SPDX-License-Identifier: Apache-2.0
// The part of the configuration about media between the ends that attenuate a wave without turning it: the air, and
// vegetation.
// Defaults are defined here; the field table (host/config/outdoors_fields.cpp) gives the reason for each.
#pragma once
#include <array>
#include <string>

#include "wavetracer/choice.hpp"

namespace wavetracer {

struct AirConfig {       // [air]: attenuation of every path by the air, per metre of its length
  double rain_mm_h = 0;  // rain rate, ITU-R P.838-3; 0: none
  double fog_g_m3 = 0;   // liquid water, ITU-R P.840-8; 0: none
  bool gases = false;    // oxygen and water vapour, ITU-R P.676-13
  double temperature_c = 15, pressure_hpa = 1013.25, humidity_g_m3 = 7.5;
};

using VegetationShape = Choice<"box", "cylinder", "spheroid">;

struct VegetationConfig {  // [[vegetation]]: a volume of leaves and twigs, such as the crown of a tree
  VegetationShape shape = "spheroid";
  std::array<double, 3> centre_m{0, 0, 0};  // file coordinates
  std::array<double, 3> size_m{0, 0, 0};    // along x, y and z before the turn
  double yaw_deg = 0;                       // about z
  std::string material = "vegetation";
};

}  // namespace wavetracer
