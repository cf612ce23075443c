// SPDX-License-Identifier: Apache-2.0
// The passes of paths that go by a target and are reflected before or after it. The points of targets are receivers of
// all ends that launch rays: candidates and solve find the ways between them. These are sorted by the points and joined
// there, as prefixes of tiles are. Both ends of every link must have launched.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "kernel_calls/point_prefixes.hpp"
#include "kernel_calls/targets.hpp"
#include "passes/candidates.hpp"
#include "passes/point_join.hpp"
#include "passes/point_prefixes.hpp"
#include "passes/solve.hpp"
#include "passes/sort.hpp"
#include "passes/targets.hpp"
#include "simulation/scattered_paths.hpp"

namespace wavetracer {

class TargetChains {
 public:
  // reflections: the most before a target and after it.
  TargetChains(gpu::Context& context, uint32_t reflections, const JoinedPoints& limits);

  // Places the points of a frame. launching: the ends that launch rays, in the order of RadioEnds::transmitters.
  void place(const std::vector<EndState>& launching, const std::vector<TargetState>& targets);

  // Tests the legs of rows of ways between these ends.
  using CheckLegs = std::function<void(SolvedList& rows, const RadioEnds& ends, Counters& counters)>;
  // Makes all paths, and returns their counts. ends: those of the frame; take: takes paths whose legs have been tested.
  JoinedCounts operator()(const DeviceScene& scene, const RadioEnds& ends, const FoundSequences& found,
                          const TargetRows& targets, const CheckLegs& check_legs,
                          const std::function<void(SolvedList&)>& take);

 private:
  // Lists the sequences, and after them the roots of the ends that are no transmitters, which the list lacks. Returns
  // their number.
  uint32_t list_nodes(const FoundSequences& found, uint32_t transmitters);
  // Makes open rows of the ways, and sorts them by their points.
  void sort(SolvedList& ways, const RadioEnds& ends, const TargetRows& targets);

  gpu::Context& context_;
  uint32_t most_depth_, local_;
  RadioEnds ends_;  // the ends that launch, and the points as receivers
  gpu::Buffer<uint32_t> nodes_;
  Counters counters_;
  Candidates candidates_;
  Solve solve_;
  gpu::KernelOf<calls::targets::target_rows> rows_;
  gpu::KernelOf<calls::point_prefixes::place_points> place_;
  Sort sort_;
  PointJoin join_;
  PointPrefixList list_;
};

}  // namespace wavetracer
