// SPDX-License-Identifier: Apache-2.0
// Seconds of device stages come from the profile of the context, which starts at zero with the frame.
#include "simulation/frame_account.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "radio/constants.hpp"
#include "wavetracer/stages.hpp"

namespace wavetracer {

FrameAccount::FrameAccount(gpu::Context& context, uint32_t frame) : context_(context) {
  context.reset_profile();
  frame_.lap();
  host_.lap();
  result.frame = frame;
}

void FrameAccount::discovered(const DiscoveryCounts& found) {
  result.segments_per_depth = found.segments_per_depth;
  result.counts.rays = found.rays;
  result.counts.hits = found.hits;
  for (const uint64_t segments : found.segments_per_depth) result.counts.segments += segments;
  if (!found.beams) return;
  const BeamCounts& beams = *found.beams;
  result.certificate = {.frames = 1,
                        .depth = beams.depth,
                        .edges = beams.edges,
                        .any_depth = beams.any_depth,
                        .ends = beams.ends,
                        .left_out_sr = beams.left_out_sr,
                        .left_out_power = beams.thin_sr / (4 * std::numbers::pi),
                        .weak_sr = beams.weak_sr,
                        .floor_db = beams.floor_db};
}

void FrameAccount::counted(const wt_counters& counters, uint32_t transmitter_count, const Uncounted& besides) {
  FrameCounts& counts = result.counts;
  counts.sequences = uint64_t{counters.nodes} + counters.exchanged - transmitter_count;
  counts.candidates = uint64_t{counters.candidates} + counters.wedge_candidates + counters.chains + besides.candidates;
  counts.weak = besides.weak;
  counts.solved =
      uint64_t{counters.solved} + counters.hidden + counters.wedge_solved + counters.chains + besides.solved;
}

void FrameAccount::left_out(const LeftOut& paths, const EndName& transmitter_name, const EndName& receiver_name) {
  if (!paths.empty()) warn(left_out_warning(paths, transmitter_name, receiver_name));
}

void FrameAccount::near_edges(const std::vector<uint32_t>& paths_at, const std::vector<CarrierFields>& others,
                              double first_hz) {
  for (size_t i = 0; i < std::min(paths_at.size(), others.size() + 1); ++i)
    if (paths_at[i] > 0)
      warn(fmt::format(
          "{} of {} paths are diffracted less than a wavelength ({:.3g} m) from an antenna or from another edge, or at "
          "an edge that is shorter than that: the theory ends there, and such fields may be wrong by 3 dB and more",
          paths_at[i], result.paths.size(), speed_of_light_m_s / (i == 0 ? first_hz : others[i - 1].frequency_hz)));
}

FrameResult FrameAccount::close() {
  const double frame_seconds = frame_.lap();
  result.counts.paths = result.summed
                            ? std::accumulate(result.summed->kinds.begin(), result.summed->kinds.end(), uint64_t{0})
                            : result.paths.size();
  result.seconds = context_.profile();
  result.kernels = context_.kernel_times();
  for (const auto& [stage, seconds] : host_stages_) result.seconds[stage] = seconds;
  result.seconds["frame"] = frame_seconds;
  check_stages(result.seconds);
  return std::move(result);
}

}  // namespace wavetracer
