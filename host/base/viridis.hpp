// SPDX-License-Identifier: Apache-2.0
// The colours of numbers: viridis (S. van der Walt, N. Smith, 2015, CC0) at ten steps, from dark to bright, as sRGB.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace wavetracer {

using Colour = std::array<uint8_t, 3>;

inline constexpr std::array<Colour, 10> viridis = {{{0x44, 0x01, 0x54},
                                                    {0x48, 0x28, 0x78},
                                                    {0x3e, 0x49, 0x89},
                                                    {0x31, 0x68, 0x8e},
                                                    {0x26, 0x82, 0x8e},
                                                    {0x1f, 0x9e, 0x89},
                                                    {0x35, 0xb7, 0x79},
                                                    {0x6e, 0xce, 0x58},
                                                    {0xb5, 0xde, 0x2b},
                                                    {0xfd, 0xe7, 0x25}}};

// Returns the colour at a place from 0 (dark) to 1 (bright).
inline Colour viridis_at(double place) {
  const double at = std::clamp(place, 0.0, 1.0) * (viridis.size() - 1);
  const size_t i = std::min(static_cast<size_t>(at), viridis.size() - 2);
  Colour out;
  for (size_t k = 0; k < out.size(); ++k)
    out[k] = static_cast<uint8_t>(
        std::lround(viridis[i][k] + (viridis[i + 1][k] - viridis[i][k]) * (at - static_cast<double>(i))));
  return out;
}

}  // namespace wavetracer
