// SPDX-License-Identifier: Apache-2.0
// Writes a layer as a PNG picture of 256 colours, one pixel a cell, the first row in the north, or the highest one of a
// vertical plane: weak is dark, strong is bright, and a cell without a value is transparent. A world file says where
// the picture is.
#pragma once
#include <array>
#include <span>
#include <string>
#include "base/colours.hpp"
#include "coverage/map_place.hpp"

namespace wavetracer::coverage {

// Colours of transmitters and of beams, by their numbers; they repeat. They stay apart for most eyes: the first eight
// are those of Okabe and Ito (2008), with grey for their black.
inline constexpr std::array<Colour, 12> server_colours = {{{0x00, 0x72, 0xb2},
                                                           {0xe6, 0x9f, 0x00},
                                                           {0x00, 0x9e, 0x73},
                                                           {0xcc, 0x79, 0xa7},
                                                           {0x56, 0xb4, 0xe9},
                                                           {0xd5, 0x5e, 0x00},
                                                           {0xf0, 0xe4, 0x42},
                                                           {0x80, 0x80, 0x80},
                                                           {0x33, 0x22, 0x88},
                                                           {0x88, 0x22, 0x55},
                                                           {0x99, 0x99, 0x33},
                                                           {0x44, 0xaa, 0x99}}};
// Colours of cells without line of sight, and with it.
inline constexpr std::array<Colour, 2> sight_colours = {{{0xe6, 0x9f, 0x00}, {0x00, 0x72, 0xb2}}};

// Returns the colours of the values 0, 1 and so on of a layer of choices, which repeat; none for other layers.
std::span<const Colour> choice_colours(const LayerKind& layer);

// The values of the darkest and of the brightest colour.
struct ColourRange {
  double low = 0, high = 1;
};

// Returns the range for a layer. In layers of decibels it is whole multiples of 5 dB, at most 100 dB, around all values
// but the lowest and highest percent; probabilities have 0 to 1, and others begin at 0. Values that are not finite do
// not count.
ColourRange colour_range(const LayerKind& layer, std::span<const double> values);

// Returns a line about a picture: the layer, the grid, and for amounts the values of the darkest and brightest colour.
std::string colour_words(const Map& map, const LayerKind& layer, const ColourRange& range);

// values: row by row from the south. range: the values of the darkest and the brightest colour of a layer of amounts.
// Transmitters and beams have colours that repeat after twelve; line of sight is blue, and other paths are orange.
std::string png(const Map& map, const LayerKind& layer, std::span<const double> values, const ColourRange& range);

// Returns the six lines of the world file: the size of a pixel and the middle of the first one.
std::string world_file(const MapPlace& place);

}  // namespace wavetracer::coverage
