// SPDX-License-Identifier: Apache-2.0
// The certificate of a discovery by beams (trace.discovery = "beams"): it says what may be missing.
#pragma once
#include <algorithm>
#include <cstdint>
#include <numbers>
#include <optional>

namespace wavetracer {

// Every path of at most `depth` interactions, of which at most `edges` are at edges, was found that is not weaker than
// floor_db, unless one of its points lies in a beam that was too thin to follow.
struct Certificate {
  uint64_t frames = 0;     // frames that it is about; 0: there is no certificate
  uint32_t depth = 0;      // the smallest of all frames
  uint32_t edges = 0;      // edges that such a path may go over, the fewest of all frames; 0: reflections only
  bool any_depth = false;  // in all frames, no path has more reflections than that
  uint64_t ends = 0;       // ends from which beams were followed, added up over all frames
  double left_out_sr = 0;  // a bound of the solid angle of the beams that were too thin, over all ends and frames
  // A bound of the power in these beams, where an isotropic antenna sends 1 W. It is the largest of all frames, so no
  // link of any frame can miss more by reflected paths, but for the gain of its transmitter's antenna.
  double left_out_power = 0;
  // A bound of the solid angle of the beams that were not followed because they are weaker than floor_db, each times
  // the share of its power that mirrors have left, over all ends and frames.
  double weak_sr = 0;
  std::optional<double> floor_db = {};  // gain between isotropic antennas, dB; nothing: all beams were followed

  // The share of all directions of all ends.
  double left_out_share() const { return share_of_all(left_out_sr); }
  // The share of the power of all ends, whose antennas are isotropic.
  double weak_share() const { return share_of_all(weak_sr); }

 private:
  double share_of_all(double sr) const {
    return ends == 0 ? 0.0 : sr / (4.0 * std::numbers::pi * static_cast<double>(ends));
  }
};

inline void add(Certificate& sum, const Certificate& more) {
  sum.any_depth = (sum.frames == 0 || sum.any_depth) && (more.frames == 0 || more.any_depth);
  if (more.floor_db) sum.floor_db = more.floor_db;  // a run has one
  const auto least = [&](uint32_t a, uint32_t b) {
    return sum.frames == 0 ? b : more.frames == 0 ? a : std::min(a, b);
  };
  sum.depth = least(sum.depth, more.depth);
  sum.edges = least(sum.edges, more.edges);
  sum.frames += more.frames;
  sum.ends += more.ends;
  sum.left_out_sr += more.left_out_sr;
  sum.left_out_power = std::max(sum.left_out_power, more.left_out_power);
  sum.weak_sr += more.weak_sr;
}

// Adds the certificate of other links of the same frame.
inline void add_part(Certificate& sum, const Certificate& more) {
  const uint64_t frames = std::max(sum.frames, more.frames);
  add(sum, more);
  sum.frames = frames;
}

}  // namespace wavetracer
