// SPDX-License-Identifier: Apache-2.0
// Colours of numbers, as sRGB.
#pragma once
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

namespace wavetracer {

using Colour = std::array<uint8_t, 3>;

// Viridis (S. van der Walt, N. Smith, 2015, CC0) at ten steps, from dark to bright.
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

// Returns the colour at a place from 0, the first step, to 1, the last one. There must be two steps or more.
inline Colour colour_at(std::span<const Colour> steps, double place) {
  const double at = std::clamp(place, 0.0, 1.0) * static_cast<double>(steps.size() - 1);
  const size_t i = std::min(static_cast<size_t>(at), steps.size() - 2);
  const double part = at - static_cast<double>(i);
  Colour out;
  for (size_t k = 0; k < out.size(); ++k)
    out[k] = static_cast<uint8_t>(std::lround(steps[i][k] + (steps[i + 1][k] - steps[i][k]) * part));
  return out;
}

// Returns the colour as "#rrggbb".
inline std::string hex(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

}  // namespace wavetracer
