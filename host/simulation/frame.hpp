// SPDX-License-Identifier: Apache-2.0
// The frame: the list of passes that turn poses into paths, in the order of the table in docs/architecture.md.
// Frames of one setup share its set of sequences and its ray cache, so they are solved one after the other.
#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "simulation/discovery_clock.hpp"
#include "simulation/frame_account.hpp"
#include "simulation/frame_task.hpp"
#include "simulation/launch_plan.hpp"
#include "simulation/recall_warning.hpp"
#include "simulation/setup.hpp"
#include "wavetracer/link_figures.hpp"

namespace wavetracer {

class FrameLoop {
 public:
  // setup outlives this. On a CPU, this compiles the kernels that a frame launches.
  explicit FrameLoop(Setup& setup);
  // Throws FrameStopped if the observer has cancelled the frame, and passes on errors of poses and blocks.
  FrameResult run(FrameTask task);
  // Makes the next frame cold: it reuses nothing.
  void forget();
  // The host reads sums of links from now on, and no paths; or paths again.
  void sum_links(bool on) { summed_ = on; }
  // Memory for sums of links that later frames use: it is taken by the next one, or by whoever joins batches.
  void give_room(std::vector<LinkFigures> figures) { figures_room_ = std::move(figures); }
  std::vector<LinkFigures> take_room() { return std::exchange(figures_room_, {}); }
  // Do batches of receivers share sequences? They do if only transmitters launch rays, or edges that listeners hear,
  // and if the launch does not depend on what was found.
  bool batches_share() const;

 private:
  struct Found {
    DiscoveryCounts rays;
    wt_counters counted{};
  };

  // The same, but for beams that are kept.
  void forget_found();
  FrameResult solve(FrameTask& task);
  Found find_paths(const FrameTask& task, const WorldState& world, const RadioEnds& ends, const LinkBlock* block,
                   bool searches, bool alike, FrameAccount& account);
  void take_paths(const FrameTask& task, const DiscoveryCounts& found, const wt_counters& counted,
                  FrameAccount& account, LeftOut& left_out);
  void next_frame(Sequences& set);
  Counters::Zeroed begin_sequences(Sequences& set, bool searches);
  // The same by beams.
  DiscoveryCounts follow_beams(const FrameTask& task, const WorldState& world, const LinkBlock* block);
  DiscoveryCounts discover(const FrameTask& task, const WorldState& world, const LinkBlock* block);
  // Is the world of this task at rest, so that it is the same in all frames?
  bool rests(const FrameTask& task) const { return plan_.world.resting && task.is_as_planned(); }
  void set_ends(const FrameTask& task, const WorldState& world, const LinkBlock* block);
  Uncounted receive_paths(const RadioEnds& ends, FrameAccount& account);
  void finish_paths(uint32_t frame, const WorldState& world, const RadioEnds& ends, const std::vector<Link>* own,
                    Rows rows);
  // The floors of links for paths over edges, from the other paths of the frame; none without
  // trace.diffraction_range_db. Frames whose paths are wanted have none that the user did not ask for.
  std::optional<LinkLimits> floor_links(const WorldState& world, const RadioEnds& ends, bool compiles);
  Paths known_paths(uint32_t frame, const WorldState& world, const RadioEnds& ends, FrameAccount& account);

  Setup& s_;
  const RunPlan& plan_;
  DiscoveryClock clock_;
  DiscoveryMark discovery_;  // that of the drive
  RadioEnds ends_;           // those of the frame
  // In a world at rest, frames keep what an earlier one has made: places, the links where these are all, and the launch
  // of all ends.
  bool places_rest_ = false, links_rest_ = false;
  bool heard_ = false;  // the sequences of all batches were found with the first one
  bool summed_ = false;
  bool floors_links_ = false;  // this frame leaves out paths over edges by floors of links
  std::vector<LinkFigures> figures_room_;
  std::optional<LaunchPlan> launch_;
  std::vector<bool> standing_origins_;  // with beams: the origins that never move
  RayWitness witness_;
  uint64_t warm_frames_ = 0;  // frames since the last cold one that launched rays, with that one
};

}  // namespace wavetracer
