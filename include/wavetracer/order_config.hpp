// SPDX-License-Identifier: Apache-2.0
// The tables [order] and [launch]: the order of rays, and the shape of the launches that trace them.
#pragma once
#include <cstdint>
#include <optional>

#include "wavetracer/choice.hpp"

namespace wavetracer {

// Methods of the thesis have two words each, a plain name and a mnemonic; outputs repeat the given word.
using OrderMethod = Choice<"none", "WS", "morton", "Z", "hilbert3d-histogram", "H3DH", "morton-histogram", "HZ",
                           "hilbert3d-histogram-hilbert2d", "H3DH2DH", "hilbert3d-histogram-hilbert3d", "H3DH3DH",
                           "direction-origin", "auto">;

struct OrderConfig {
  OrderMethod method = "none";
  bool each_depth = false;
  uint32_t bin_num = 16;  // bins per direction component, histogram methods

  // The method is the one that a trial on the device finds fastest.
  bool by_trial() const { return method == "auto"; }
};

using LaunchDimensions = Choice<"auto", "1d", "2d", "3d">;

struct LaunchConfig {
  LaunchDimensions shape = "auto";
  std::optional<uint32_t> local_size = {};  // work-items per work-group; not given: chosen for the device
};

}  // namespace wavetracer
