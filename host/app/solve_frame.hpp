// One frame of a run, as often as --repeat asks for.
// An interrupt ends it after the repeat in progress, so there is always a result.
#pragma once
#include <optional>
#include "wavetracer/simulation.hpp"

namespace wavetracer::app {

struct SolvedFrame {
  FrameResult result;     // that of the last repeat, with the median time of each stage
  uint32_t repeated = 0;  // how many repeats there were
};

// Where frames reuse sequences and there is more than one repeat, each of them begins cold.
// block: the links of these transmitters alone.
SolvedFrame solve_frame(Simulation& simulation, uint32_t frame, uint32_t repeats,
                        std::optional<TransmitterRange> block = {});

}  // namespace wavetracer::app
