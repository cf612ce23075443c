// From what rays have found to paths: candidates of every kind, solved exactly, their legs checked.
// Each kind of path has its candidates and its solve; legs, visibility and merging are the same for all.
#pragma once
#include <optional>

#include "passes/candidates.hpp"
#include "passes/occlusion.hpp"
#include "passes/scatter.hpp"
#include "passes/solve.hpp"
#include "passes/transmissions.hpp"
#include "passes/visible.hpp"
#include "simulation/diffracted_paths.hpp"
#include "simulation/frame_watch.hpp"
#include "simulation/listeners.hpp"
#include "base/stopwatch.hpp"
#include "simulation/world.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

class ExactPaths {
 public:
  // trace: see with_features.
  ExactPaths(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, const World& world,
             const TraceConfig& trace, const Origins& origins);
  // Is told of the kinds of paths that are solved; outlives this.
  void watch(const FrameWatch& watch) { watch_ = &watch; }
  // The paths of the frame, each once; host is left at the time since the device was done.
  PathGeometry operator()(const DeviceScene& scene, const RadioEnds& ends, Sequences& sequences, FrameCounts& counts,
                          Stopwatch& host);

 private:
  SolvedList& specular(const DeviceScene& scene, const RadioEnds& ends, Sequences& sequences, uint32_t node_count,
                       FrameCounts& counts);
  // Marks the solved paths that have a leg which is obstructed, or passes more than it may.
  void check_legs(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, FrameCounts& counts);
  void append(const SolvedList& solved, Sequences& sequences, PathGeometry& paths, Stopwatch& host);

  // Kinds of paths that are done.
  void tell(uint64_t done) const {
    if (watch_) (*watch_)("paths", done, 1 + diffraction_.has_value() + scatter_.has_value());
  }

  uint32_t max_depth_;
  Candidates candidates_;
  Solve solve_;
  std::optional<DiffractedPaths> diffraction_;
  std::optional<Scatter> scatter_;
  std::optional<Occlusion> occlusion_;  // one of these two
  std::optional<Transmissions> transmissions_;
  Visible visible_;
  const FrameWatch* watch_ = nullptr;
};

}  // namespace wavetracer
