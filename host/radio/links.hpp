// SPDX-License-Identifier: Apache-2.0
// The figures of links (wavetracer/link_figures.hpp), from the paths of a frame.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "wavetracer/link_figures.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// One entry for each of the frame's links, in their order; a link without a path is there with paths = 0.
// links: sorted, as in WorldState. paths: sorted as Paths says; rows of other frames and other links are skipped.
std::vector<LinkFigures> link_figures(const Paths& paths, uint32_t frame, std::span<const Link> links,
                                      double frequency_hz);

}  // namespace wavetracer
