// SPDX-License-Identifier: Apache-2.0
// The chains of facets between which waves may bounce within a body: mirrors, and the piece that scatters after them.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "radio/target_pieces.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

struct BodyBounce {
  uint32_t piece;                   // index into the pieces of the body
  uint32_t count;                   // the number of mirrors, 1 or 2
  std::array<uint32_t, 2> mirrors;  // surfaces of the model, in their order from an end
};

// All chains of two facets up to `bounces` that may be met: a lit side of each facet sees a part of the next one, and a
// lit side of the last mirror sees the middle of the piece. Parts of the body between them are not looked at. A body
// that is nowhere hollow has none. They are ordered by pieces. Throws ConfigError, with the name of the target's model,
// where they are too many.
std::vector<BodyBounce> bounces_of_body(const Scene& model, const std::vector<TargetPiece>& pieces, uint32_t bounces,
                                        const std::string& target_model);

}  // namespace wavetracer
