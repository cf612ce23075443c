// SPDX-License-Identifier: Apache-2.0
// The certificate of a discovery by beams (trace.discovery = "beams"): it says what may be missing.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numbers>

namespace wavetracer {

// Every path of at most `depth` reflections was found, unless one of its points lies in a beam that was too thin to
// follow.
struct Certificate {
  uint64_t frames = 0;     // frames that it is about; 0: there is no certificate
  uint32_t depth = 0;      // the smallest of all frames
  uint64_t ends = 0;       // ends from which beams were followed, added up over all frames
  double left_out_sr = 0;  // a bound of the solid angle of the beams that were not followed, over all ends and frames

  // The share of all directions of all ends.
  double left_out_share() const {
    return ends == 0 ? 0.0 : left_out_sr / (4.0 * std::numbers::pi * static_cast<double>(ends));
  }
};

inline void add(Certificate& sum, const Certificate& more) {
  sum.depth = sum.frames == 0 ? more.depth : more.frames == 0 ? sum.depth : std::min(sum.depth, more.depth);
  sum.frames += more.frames;
  sum.ends += more.ends;
  sum.left_out_sr += more.left_out_sr;
}

// Adds the certificate of other links of the same frame.
inline void add_part(Certificate& sum, const Certificate& more) {
  const uint64_t frames = std::max(sum.frames, more.frames);
  add(sum, more);
  sum.frames = frames;
}

}  // namespace wavetracer
