// SPDX-License-Identifier: Apache-2.0
// Generates a city: blocks between straight streets, buildings of several shapes, roofs and ITU materials.
// The same options give the same bytes on every platform: all choices are integers, all coordinates multiples of 1/8 m.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/raw_scene.hpp"

namespace wavetracer {

// The city is centred on the origin, z = 0 is the ground. Street centre lines run along
//   x = (i - blocks_x / 2) * (block_m + street_m), i = 0 .. blocks_x, and likewise in y;
// with the defaults x, y = -300, -200, -100, 0, 100, 200, 300 m. Streets are free of buildings over their whole width,
// so an antenna may stand anywhere within street_m / 2 of a centre line: see example_positions().
struct CityOptions {
  uint64_t seed = 1;
  uint32_t blocks_x = 6, blocks_y = 6;      // with even numbers, a crossing lies on the origin
  uint32_t block_m = 80, street_m = 20;     // side of the square blocks, width of the streets
  uint32_t min_floors = 3, max_floors = 9;  // a floor is 3.25 m high; towers get up to twice the maximum
  std::string ground = "concrete";          // any ITU material; Sionna RT 1.x does not know asphalt_concrete
};

// Parses "--seed 7 --blocks 8x6 --block-m 80 --street-m 20 --floors 3:9 --ground concrete"; each option is optional and
// may be written as --key=value. Options of traffic (city_traffic.hpp) may stand among them. Throws ConfigError.
CityOptions parse_city_options(std::string_view text);

// Returns the city in memory: one mesh for the ground, and for each building one for its walls and one for its roof.
// Buildings are closed solids that reach 1 m into the ground and stand at least 2 m apart.
RawScene generate_city(const CityOptions& options);

// Writes folder/city.xml and folder/meshes/*.ply, for this program, Sionna RT and Mitsuba. Creates the folder.
// Throws RuntimeError if the folder or a file cannot be written.
void write_city(const CityOptions& options, const std::filesystem::path& folder);

// A place in the streets, in metres, where an antenna makes sense in any city.
struct CityPosition {
  std::string name;  // "road-side unit", ...
  std::array<double, 3> position_m;
};
std::vector<CityPosition> example_positions(const CityOptions& options);

}  // namespace wavetracer
