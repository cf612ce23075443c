// SPDX-License-Identifier: Apache-2.0
// The account of a frame, apart from its list of passes: counts, seconds and warnings.
#pragma once
#include "base/stopwatch.hpp"
#include "gpu/gpu.hpp"
#include "radio/fields.hpp"
#include "simulation/launch.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// Counts that no counter has: rows of scattering, and the parts of a list except its last one.
struct Uncounted {
  uint64_t candidates = 0, solved = 0, weak = 0;
  DiscoveryCounts rays = {};  // those of edges
};

class FrameAccount {
 public:
  // Begins the frame. context outlives this.
  FrameAccount(gpu::Context& context, uint32_t frame);

  // Ends a stage of the host: its seconds are those since the stage before, or since device_done().
  void end_stage(Stage stage) { host_stages_[std::string(stage_name(stage))] += host_.lap(); }
  // The device has finished what the host waited for: the time until now belongs to no stage of the host.
  void device_done() { host_.lap(); }

  void discovered(const DiscoveryCounts& found);
  void counted(const wt_counters& counters, uint32_t transmitter_count, const Uncounted& besides);
  void warn(std::string text) { result.warnings.push_back(std::move(text)); }
  // Reports paths of near ends that were left out. names: those of the ends of the frame.
  void left_out(const LeftOut& paths, const EndName& transmitter_name, const EndName& receiver_name);
  // Reports paths that are closer to an edge than the theory of diffraction holds: at the first carrier and the others.
  void near_edges(const std::vector<uint32_t>& paths_at, const std::vector<CarrierFields>& others, double first_hz);
  // Returns the complete result.
  FrameResult close();

  FrameResult result;  // the result so far

 private:
  gpu::Context& context_;
  Stopwatch frame_, host_;
  StageSeconds host_stages_;
};

}  // namespace wavetracer
