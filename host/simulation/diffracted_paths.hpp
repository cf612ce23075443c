// Diffracted paths of a frame: what prefixes of both ends see is sorted by wedge, joined there, and solved.
// Assumes that both ends of every link have launched, and that place has run.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/sequences.hpp"
#include "passes/sort.hpp"
#include "passes/wedge_join.hpp"
#include "passes/wedge_prefixes.hpp"
#include "passes/wedge_solve.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

class DiffractedPaths {
 public:
  // wedges: of the world; receiver_of_origin: see WedgeJoin.
  DiffractedPaths(gpu::Context& context, Wedges wedges, const std::vector<uint32_t>& receiver_of_origin,
                  const TraceConfig& config);
  // Solved, but not checked for visibility. candidates: how many there were.
  SolvedList& operator()(const DeviceScene& scene, const RadioEnds& ends, Sequences& sequences, uint32_t node_count,
                         uint64_t& candidates);

 private:
  gpu::Context& context_;
  Wedges wedges_;
  WedgePrefixes prefixes_;
  Sort sort_;
  WedgeJoin join_;
  WedgeSolve solve_;
  gpu::Buffer<uint32_t> temporary_;
};

}  // namespace wavetracer
