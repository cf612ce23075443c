// One frame of a run, as often as --repeat asks for.
// An interrupt ends it between two steps; repeats that are done by then count.
#pragma once
#include <optional>
#include "jobs/progress.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

struct SolvedFrame {
  FrameResult result;     // that of the last repeat, with the median time of each stage
  uint32_t repeated = 0;  // how many repeats there were
};

// Nothing where an interrupt came before the first repeat was done. Where frames reuse sequences and there is more than
// one repeat, each of them begins cold. A run of one frame tells the progress how far it is.
// block: the links of these transmitters alone.
std::optional<SolvedFrame> solve_frame(Simulation& simulation, uint32_t frame, uint32_t repeats, Progress& progress,
                                       std::optional<TransmitterRange> block = {});

}  // namespace wavetracer
