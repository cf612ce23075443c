// SPDX-License-Identifier: Apache-2.0
// The frame: the list of passes that turn poses into paths, in the order of the table in docs/architecture.md.
// Frames of one setup share its set of sequences and its ray cache, so they are solved one after the other.
#pragma once
#include <functional>
#include <optional>

#include "simulation/discovery_clock.hpp"
#include "simulation/frame_account.hpp"
#include "simulation/link_block.hpp"
#include "simulation/setup.hpp"

namespace wavetracer {

// The inputs of a frame.
struct FrameTask {
  uint32_t frame = 0;
  std::function<WorldState()> pose = {};              // gives the state of the world
  EndName transmitter_name = {}, receiver_name = {};  // for warnings; called after pose
  std::optional<TransmitterRange> transmitters = {};  // only the links of these; not set: all
  std::optional<ReceiverRange> receivers = {};        // only the links of these; not set: all
  LeftOut* left_out = nullptr;                        // a part of a frame adds its own here; the whole warns
  bool timed = true;                                  // stages on the device are profiled
  DiscoveryMark* discovery = nullptr;                 // that of the source of poses; null: that of the drive
  bool between = false;  // the time is between two frames of poses: launches no rays if that is allowed
  bool is_block() const { return transmitters || receivers; }
  bool compiling = false;  // launches only compile: few rays, no warnings
};

class FrameLoop {
 public:
  // setup outlives this. On a CPU, this compiles the kernels that a frame launches.
  explicit FrameLoop(Setup& setup);
  // Throws FrameStopped if the observer has cancelled the frame, and passes on errors of poses and blocks.
  FrameResult run(const FrameTask& task);
  // Makes the next frame cold: it reuses nothing.
  void forget();

 private:
  struct Found {
    DiscoveryCounts rays;
    wt_counters counted{};
  };

  FrameResult solve(const FrameTask& task);
  Found find_paths(const FrameTask& task, const WorldState& world, const RadioEnds& ends, const LinkBlock* block,
                   bool searches, bool alike, FrameAccount& account);
  void next_frame(Sequences& set);
  void begin_sequences(Sequences& set, bool searches);
  DiscoveryCounts discover(const FrameTask& task, const WorldState& world, const LinkBlock* block);
  Uncounted receive_paths(const RadioEnds& ends, FrameAccount& account);
  void finish_paths(uint32_t frame, const WorldState& world, const RadioEnds& ends, const std::vector<Link>* own,
                    bool carriers);
  Paths known_paths(const FrameTask& task, const WorldState& world, const RadioEnds& ends, FrameAccount& account);

  Setup& s_;
  const RunPlan& plan_;
  DiscoveryClock clock_;
  DiscoveryMark discovery_;   // that of the drive
  RadioEnds ends_;            // those of the frame
  uint64_t warm_frames_ = 0;  // frames since the last cold one that launched rays, with that one
};

// Finds the exact paths of the sequences that rays have found, in exact.visible.list(). searched: rays may have added
// sequences since the last call; then their exchanges are added. Returns the counts that no counter has.
Uncounted solve_paths(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set, bool searched,
                      const FrameWatch& watch, FrameAccount& account);

}  // namespace wavetracer
