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
  std::function<WorldState()> pose = {};              // where everything is
  EndName transmitter_name = {}, receiver_name = {};  // for warnings; asked after the poses
  std::optional<TransmitterRange> transmitters = {};  // only the links of these; not given: all
  std::optional<ReceiverRange> receivers = {};        // likewise
  LeftOut* left_out = nullptr;                        // a part of a frame adds its own here instead of a warning
  bool timed = true;                                  // its stages on the device are profiled
  DiscoveryMark* discovery = nullptr;                 // of the source of poses; null: of the drive
  bool between = false;  // two frames of poses: launches no rays where frames may do without
  bool is_block() const { return transmitters || receivers; }
  bool compiling = false;  // launches are there to be compiled: few rays, and no warnings
};

class FrameLoop {
 public:
  // setup outlives this. On a CPU, compiles what a frame launches.
  explicit FrameLoop(Setup& setup);
  // Throws FrameStopped if the observer has cancelled the frame, and the errors of poses and blocks.
  FrameResult run(const FrameTask& task);
  // The next frame is cold: it reuses nothing.
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
  DiscoveryMark discovery_;   // of the drive
  RadioEnds ends_;            // of the frame
  uint64_t warm_frames_ = 0;  // that launched rays since the last cold one, which counts
};

// Finds the exact paths of the sequences that rays have found, in exact.visible.list(). searched: rays may have added
// sequences since the call before, whose exchanges are added then. Returns what no counter has.
Uncounted solve_paths(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set, bool searched,
                      const FrameWatch& watch, FrameAccount& account);

}  // namespace wavetracer
