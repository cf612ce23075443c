// SPDX-License-Identifier: Apache-2.0
// Joins wedges that follow one another on a line.
// Pieces of edges must lie between numbered joints, each once.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

struct WedgePiece {
  std::array<uint32_t, 2> joints;  // at the start and the end of the wedge
  Wedge wedge;
};

// Joins pieces that share a joint, the line (2 mm), both surfaces and the angle (1 mrad). The result is sorted by first
// piece.
std::vector<Wedge> join_rows(std::span<const WedgePiece> pieces);

}  // namespace wavetracer
