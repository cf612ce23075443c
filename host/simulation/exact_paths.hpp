// SPDX-License-Identifier: Apache-2.0
// The passes that lead from the results of rays to paths; the frame calls them in their order (frame.cpp).
// Each kind of path has its candidates and its solve; legs, visibility and merging are the same for all.
#pragma once
#include <optional>

#include "base/stopwatch.hpp"
#include "passes/candidates.hpp"
#include "passes/crowns.hpp"
#include "passes/occlusion.hpp"
#include "passes/scatter.hpp"
#include "passes/solve.hpp"
#include "passes/target_bounces.hpp"
#include "passes/targets.hpp"
#include "passes/transmissions.hpp"
#include "passes/visible.hpp"
#include "simulation/diffracted_paths.hpp"
#include "simulation/edge_discovery.hpp"
#include "simulation/listeners.hpp"
#include "simulation/scattered_edges.hpp"
#include "simulation/scattered_paths.hpp"
#include "simulation/target_chains.hpp"
#include "simulation/world.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

struct ExactPaths {
  // trace: see with_features. frames_follow: a path that is hidden in a frame is mostly hidden in the next one, too.
  ExactPaths(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, const World& world,
             const TraceConfig& trace, double longest_wavelength_m, bool frames_follow);

  // Marks the solved paths with a leg that is obstructed, or that passes through more surfaces than allowed.
  // remember: rows of candidates leave what hides them, for the next frame.
  void check_legs(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, Counters& counters,
                  bool remember = true);
  // Places the targets of a frame, if there are any. listeners: the receivers that launch rays.
  void place_targets(const WorldState& world, const std::vector<uint32_t>& listeners);
  // The number of kinds of paths: specular, diffracted, scattered off surfaces, without and with reflections, off
  // vegetation, and off targets, without reflections, with bounces within a body, and with reflections.
  uint64_t kinds() const {
    return 1 + uint64_t{diffraction.has_value()} + uint64_t{scatter.has_value()} + uint64_t{scattered.has_value()} +
           uint64_t{crowns.has_value()} + uint64_t{targets.has_value()} + uint64_t{target_bounces.has_value()} +
           uint64_t{target_chains != nullptr};
  }

  uint32_t max_depth;
  Candidates candidates;
  std::optional<Blockers> blockers;  // set where frames follow each other and legs are not listed
  Solve solve;
  std::optional<DiffractedPaths> diffraction;
  std::unique_ptr<EdgeDiscovery> from_edges;  // with trace.edge_rays, else null
  std::optional<Scatter> scatter;
  std::optional<ScatteredPaths> scattered;          // with trace.scattering_reflections
  std::unique_ptr<ScatteredEdges> scattered_edges;  // with trace.scattering_diffraction, else null
  std::optional<Crowns> crowns;
  std::optional<TargetRows> targets;
  std::optional<TargetBodies> target_bodies;    // set if bodies of vehicles are targets
  std::optional<TargetBounces> target_bounces;  // set if waves bounce within bodies that are targets
  std::unique_ptr<TargetChains> target_chains;  // with trace.target_reflections, else null
  std::optional<Occlusion> occlusion;           // this or the next one is set
  std::optional<Transmissions> transmissions;
  Visible visible;

 private:
  void add_scattering(gpu::Context& context, const Scene& scene, const World& world, const TraceConfig& trace,
                      double longest_wavelength_m);
  void add_targets(gpu::Context& context, const World& world, const TraceConfig& trace, double longest_wavelength_m);
};

}  // namespace wavetracer
