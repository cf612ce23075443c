// SPDX-License-Identifier: Apache-2.0
// Tasks are values: each batch of a frame gets one of its own.
#include "simulation/frame_task.hpp"

#include <string>
#include <utility>
#include <vector>

namespace wavetracer {

FrameNames::FrameNames(EndName transmitter_name, EndName receiver_name)
    : transmitter(std::move(transmitter_name)), receiver(std::move(receiver_name)) {}

FrameNames FrameNames::of(const Config& config) {
  const auto name = [](const std::vector<RadioEnd>& ends) { return [&](uint32_t end) { return ends[end].name; }; };
  return {name(config.transmitters), name(config.receivers)};
}

FrameNames FrameNames::none() {
  const auto no_name = [](uint32_t) { return std::string(); };
  return {no_name, no_name};
}

LinkPart LinkPart::batch(ReceiverRange receivers, LeftOut& left_out, bool later) const {
  LinkPart out = *this;
  out.batch_ = Batch{receivers, &left_out, later};
  return out;
}

FrameTask::FrameTask(FrameInput input, Kind kind) : input_(std::move(input)), kind_(std::move(kind)) {}

FrameTask FrameTask::of_drive(FrameInput input, LinkPart links) { return {std::move(input), Drive{links}}; }

FrameTask FrameTask::of_poses(FrameInput input, DiscoveryMark& mark) { return {std::move(input), Poses{&mark}}; }

FrameTask FrameTask::between_poses(FrameInput input, const DiscoveryMark& mark) {
  return {std::move(input), BetweenPoses{mark}};
}

FrameTask FrameTask::to_compile(std::function<WorldState()> pose) {
  return {{.frame = 0, .pose = std::move(pose), .names = FrameNames::none()}, Compiling{}};
}

LinkPart FrameTask::links() const {
  const Drive* drive = std::get_if<Drive>(&kind_);
  return drive ? drive->links : LinkPart();
}

DiscoveryMark& FrameTask::mark(DiscoveryMark& of_drive) {
  if (const Poses* poses = std::get_if<Poses>(&kind_)) return *poses->mark;
  if (BetweenPoses* between = std::get_if<BetweenPoses>(&kind_)) return between->mark;
  return of_drive;
}

}  // namespace wavetracer
