// SPDX-License-Identifier: Apache-2.0
// Solves frames of a run, repeated as --repeat says. A repeat solves all frames of a unit again, the first one without
// earlier results, so each repeat finds what a run without repeats finds. An interrupt ends a frame between two steps.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>
#include "jobs/progress.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// Says in a few words what a frame does: "40% of its rays".
std::string words_of(const FrameProgress& at);

// Solves one frame once; returns nothing if it was interrupted. block: only the links of these transmitters. alone: the
// run has this one frame and no repeats, so progress is shown within the frame.
std::optional<FrameResult> solve_frame(Simulation& simulation, uint32_t frame, bool alone, Progress& progress,
                                       std::optional<TransmitterRange> block = {});

// The results of repeating one frame.
class FrameRepeats {
 public:
  void add(const FrameResult& frame);
  // Gives the result of the last repeat the median time of each stage and the warnings of all repeats. must_agree: adds
  // a warning if repeats found different numbers of paths.
  void finish(FrameResult& last, bool must_agree) const;
  uint32_t count() const { return static_cast<uint32_t>(paths_.size()); }

 private:
  std::map<std::string, std::vector<double>> seconds_;  // by stage, one value per repeat
  std::vector<uint64_t> paths_;
  std::set<std::string> warnings_;
};

// Tells whether repeats of a frame must find the same paths on a device that works.
bool repeats_agree(const Config& config);

}  // namespace wavetracer
