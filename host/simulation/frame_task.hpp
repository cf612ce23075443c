// SPDX-License-Identifier: Apache-2.0
// The task of a frame: the instant that is computed, for whom, and how. There are four kinds of tasks, and each is made
// by a function of its own, so that it holds nothing that belongs to another kind.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <variant>

#include "radio/fields.hpp"
#include "simulation/link_block.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// The names of a frame's ends, for warnings.
struct FrameNames {
  FrameNames(EndName transmitter_name, EndName receiver_name);
  // The names of the ends of a configuration, which outlives them.
  static FrameNames of(const Config& config);
  // Empty names.
  static FrameNames none();

  EndName transmitter, receiver;
};

struct FrameInput {
  uint32_t frame;                    // number of the frame
  std::function<WorldState()> pose;  // gives the state of the world
  FrameNames names;                  // asked after pose
  bool timed = true;                 // stages on the device are profiled
  bool as_planned = false;           // pose gives the world of the plan, which may be at rest
};

// The links of a drive's frame that are computed.
class LinkPart {
 public:
  // All links of the frame.
  LinkPart() = default;
  // Those of a block of transmitters.
  explicit LinkPart(TransmitterRange block) : transmitters_(block) {}
  // Those of this part that end at a batch of receivers. The paths that the batch leaves out are added to left_out,
  // which outlives the part: whoever joins the batches warns of them, and computes the elements of arrays. later: it
  // follows another batch of the same frame, whose sequences may serve it, too.
  LinkPart batch(ReceiverRange receivers, LeftOut& left_out, bool later) const;

  bool is_all() const { return !transmitters_ && !batch_; }
  bool is_batch() const { return batch_.has_value(); }
  bool is_later_batch() const { return batch_ && batch_->later; }
  TransmitterRange transmitters() const { return transmitters_.value_or(TransmitterRange{0, no_end}); }
  ReceiverRange receivers() const { return batch_ ? batch_->receivers : ReceiverRange{}; }
  // Adds the paths that the batch has left out. Throws std::bad_optional_access if this is no batch.
  void add_left_out(LeftOut more) const { batch_.value().left_out->merge(more); }

 private:
  struct Batch {
    ReceiverRange receivers;
    LeftOut* left_out;
    bool later;
  };

  std::optional<TransmitterRange> transmitters_;
  std::optional<Batch> batch_;
};

class FrameTask {
 public:
  // A frame of the drive, or a part of its links.
  static FrameTask of_drive(FrameInput input, LinkPart links = {});
  // A frame of poses that come at run time. mark: that of the source of poses, which outlives the task.
  static FrameTask of_poses(FrameInput input, DiscoveryMark& mark);
  // A time between two frames of poses, whose source has this mark and keeps it. Launches no rays if that is allowed.
  static FrameTask between_poses(FrameInput input, const DiscoveryMark& mark);
  // A frame that compiles what frames launch: few rays of one transmitter, no warnings, no elements.
  static FrameTask to_compile(std::function<WorldState()> pose);

  uint32_t frame() const { return input_.frame; }
  bool is_timed() const { return input_.timed; }
  bool is_as_planned() const { return input_.as_planned; }
  const FrameNames& names() const { return input_.names; }
  WorldState pose() const { return input_.pose(); }
  bool only_compiles() const { return std::holds_alternative<Compiling>(kind_); }
  bool is_between_poses() const { return std::holds_alternative<BetweenPoses>(kind_); }
  // The links that are computed: all, except in parts of a drive's frame.
  LinkPart links() const;
  // The mark that tells whether rays are due; of_drive: the drive's.
  DiscoveryMark& mark(DiscoveryMark& of_drive);

 private:
  struct Drive {
    LinkPart links;
  };
  struct Poses {
    DiscoveryMark* mark;
  };
  struct BetweenPoses {
    DiscoveryMark mark;
  };
  struct Compiling {};
  using Kind = std::variant<Drive, Poses, BetweenPoses, Compiling>;

  FrameTask(FrameInput input, Kind kind);

  FrameInput input_;
  Kind kind_;
};

}  // namespace wavetracer
