// SPDX-License-Identifier: Apache-2.0
// Writes a layer as a PNG picture of 256 colours, one pixel a cell, the first row in the north: weak is dark, strong is
// bright, and a cell without a value is transparent. A world file says where the picture is.
#pragma once
#include <span>
#include <string>
#include "coverage/map_place.hpp"

namespace wavetracer::coverage {

// The values of the darkest and of the brightest colour.
struct ColourRange {
  double low = 0, high = 1;
};

// Returns the range for a layer. In layers of decibels it is whole multiples of 5 dB, at most 100 dB, around all values
// but the lowest and highest percent; in others it begins at 0. Values that are not finite do not count.
ColourRange colour_range(const LayerKind& layer, std::span<const double> values);

// values: row by row from the south. Transmitters have colours of their own that repeat after twelve; line of sight is
// blue, and other paths are orange.
std::string png(const Map& map, const LayerKind& layer, std::span<const double> values);

// Returns the six lines of the world file: the size of a pixel and the middle of the first one.
std::string world_file(const MapPlace& place);

}  // namespace wavetracer::coverage
