// Frames of a run, as often as --repeat asks for. A repeat goes over all frames of a unit again, from a cold first one
// on, so each repeat finds what a run without repeats finds. An interrupt ends a frame between two steps.
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

// One frame, once; nothing where it was interrupted. block: the links of these transmitters alone. alone: the run has
// this one frame and no repeats, so the progress tells how far the frame is.
std::optional<FrameResult> solve_frame(Simulation& simulation, uint32_t frame, bool alone, Progress& progress,
                                       std::optional<TransmitterRange> block = {});

// The result of repeating one frame.
class FrameRepeats {
 public:
  void add(const FrameResult& frame);
  // Gives the result of the last repeat the median time of each stage and the warnings of all repeats. must_agree: a
  // warning says where repeats found different numbers of paths.
  void finish(FrameResult& last, bool must_agree) const;
  uint32_t count() const { return static_cast<uint32_t>(paths_.size()); }

 private:
  std::map<std::string, std::vector<double>> seconds_;  // by stage, of each repeat
  std::vector<uint64_t> paths_;
  std::set<std::string> warnings_;
};

// Do repeats of a frame find the same paths on a device that works?
bool repeats_agree(const Config& config);

}  // namespace wavetracer
