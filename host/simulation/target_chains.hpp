// SPDX-License-Identifier: Apache-2.0
// The passes of paths that go by a target and are reflected or diffracted before or after it. The points of targets are
// receivers of all ends that launch rays: candidates and solve find the ways between them, target_edges and wedge_solve
// those over one edge. These are sorted by the points and joined there, as prefixes of tiles are. Both ends of every
// link must have launched.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "kernel_calls/point_prefixes.hpp"
#include "kernel_calls/targets.hpp"
#include "passes/candidates.hpp"
#include "passes/point_join.hpp"
#include "passes/point_prefixes.hpp"
#include "passes/solve.hpp"
#include "passes/sort.hpp"
#include "passes/target_edges.hpp"
#include "passes/targets.hpp"
#include "passes/visible.hpp"
#include "passes/wedge_solve.hpp"
#include "simulation/scattered_paths.hpp"
#include "simulation/seen_edges.hpp"

namespace wavetracer {

class TargetChains {
 public:
  // interactions: the most before a target and after it. With limits.diffractions, one of those on either side may be
  // an edge; longest_wavelength_m: see WedgeSolve. With a floor, ends do not look for points from which their paths are
  // surely below it, whatever the other end.
  TargetChains(gpu::Context& context, uint32_t interactions, const JoinedPoints& limits, double longest_wavelength_m);

  bool takes_edges() const { return edge_ways_.has_value(); }

  // Places the points of a frame. launching: the ends that launch rays, in the order of RadioEnds::transmitters.
  void place(const std::vector<EndState>& launching, const std::vector<TargetState>& targets);

  // Tests the legs of rows of ways between these ends.
  using CheckLegs = std::function<void(SolvedList& rows, const RadioEnds& ends, Counters& counters)>;
  // Makes all paths, and returns their counts. ends: those of the frame; edges: null without diffraction beside
  // targets; take: takes paths whose legs have been tested.
  JoinedCounts operator()(const DeviceScene& scene, const RadioEnds& ends, const FoundSequences& found,
                          const TargetRows& targets, const SeenEdges* edges, const CheckLegs& check_legs,
                          const std::function<void(SolvedList&)>& take);

 private:
  // Lists the sequences, and after them the roots of the ends that are no transmitters, which the list lacks. Returns
  // their number.
  uint32_t list_nodes(const FoundSequences& found, uint32_t transmitters);
  // The ways between ends and points by mirrors; their legs have been tested.
  SolvedList& mirrored_ways(const DeviceScene& scene, const FoundSequences& found, uint32_t transmitters,
                            const CheckLegs& check_legs);
  // Adds the ways over one edge to edge_ways_->all.
  void add_edge_ways(const DeviceScene& scene, const FoundSequences& found, const TargetRows& targets,
                     const SeenEdges& edges, const CheckLegs& check_legs);
  // Makes open rows of the ways, and sorts them by their points.
  void sort(const DeviceScene& scene, SolvedList& ways, const RadioEnds& ends, const TargetRows& targets);

  gpu::Context& context_;
  JoinedPoints limits_;
  uint32_t local_;
  RadioEnds ends_;  // the ends that launch, and the points as receivers
  gpu::Buffer<uint32_t> nodes_;
  Counters counters_;
  Candidates candidates_;
  Solve solve_;
  struct EdgeWays {
    TargetEdges pass;
    WedgeSolve solve;
    Visible all;  // the ways that nothing obstructs, of all kinds
  };
  std::optional<EdgeWays> edge_ways_;
  gpu::KernelOf<calls::targets::target_rows> rows_;
  gpu::KernelOf<calls::point_prefixes::place_points> place_;
  Sort sort_;
  PointJoin join_;
  PointPrefixList list_;
};

}  // namespace wavetracer
