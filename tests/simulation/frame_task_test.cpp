// SPDX-License-Identifier: Apache-2.0
// Tasks of frames, without a device: the links of each part, and whose mark a frame changes.
#include "simulation/frame_task.hpp"

#include <doctest/doctest.h>

using namespace wavetracer;

namespace {

WorldState world_at(double time_s) {
  WorldState out;
  out.time_s = time_s;
  return out;
}

FrameInput input() {
  return {.frame = 7, .pose = [] { return world_at(3); }, .names = FrameNames::none(), .timed = false};
}

}  // namespace

TEST_CASE("the links of a drive's frame: all, a block, and batches of either") {
  const LinkPart all, block(TransmitterRange{2, 5});
  LeftOut left_out;
  CHECK(all.is_all());
  CHECK(!block.is_all());
  CHECK(!block.is_batch());
  CHECK(block.receivers().first == 0);
  CHECK(block.receivers().end == no_end);
  for (const LinkPart& part : {all, block}) {
    const LinkPart batch = part.batch({10, 20}, left_out, false);
    CHECK(batch.is_batch());
    CHECK(!batch.is_all());
    CHECK(batch.transmitters().first == part.transmitters().first);
    CHECK(batch.transmitters().end == part.transmitters().end);
    CHECK(batch.receivers().first == 10);
    CHECK(batch.receivers().end == 20);
    CHECK(!part.is_batch());  // as it was
  }
  CHECK(all.transmitters().end == no_end);
  CHECK(block.transmitters().end == 5);
}

TEST_CASE("batches add what they leave out to one list; what is no batch has none") {
  LeftOut left_out;
  const LinkPart all;
  all.batch({0, 1}, left_out, false).add_left_out({{Link{0, 0}, 2}});
  all.batch({1, 2}, left_out, true).add_left_out({{Link{0, 1}, 3}});
  CHECK(left_out == LeftOut{{Link{0, 0}, 2}, {Link{0, 1}, 3}});
  CHECK_THROWS_AS(all.add_left_out({}), std::bad_optional_access);
}

TEST_CASE("a frame of poses changes the mark of their source; one between two frames of poses does not") {
  DiscoveryMark of_drive, of_source{.time_s = 1.0, .active = {}};
  FrameTask drive = FrameTask::of_drive(input()), poses = FrameTask::of_poses(input(), of_source),
            between = FrameTask::between_poses(input(), of_source),
            compiling = FrameTask::to_compile([] { return WorldState{}; });
  CHECK(&drive.mark(of_drive) == &of_drive);
  CHECK(&compiling.mark(of_drive) == &of_drive);
  CHECK(&poses.mark(of_drive) == &of_source);
  CHECK(between.mark(of_drive).time_s == 1.0);
  between.mark(of_drive).time_s = 2.0;
  CHECK(between.mark(of_drive).time_s == 2.0);
  CHECK(of_source.time_s == 1.0);
  CHECK(!of_drive.time_s);
}

TEST_CASE("each kind of task answers for itself") {
  DiscoveryMark mark;
  LeftOut left_out;
  const FrameTask drive = FrameTask::of_drive(input(), LinkPart().batch({3, 4}, left_out, false));
  const FrameTask poses = FrameTask::of_poses(input(), mark), between = FrameTask::between_poses(input(), mark);
  const FrameTask compiling = FrameTask::to_compile([] { return world_at(5); });
  CHECK(drive.links().is_batch());
  for (const FrameTask* task : {&poses, &between, &compiling}) CHECK(task->links().is_all());
  for (const FrameTask* task : {&drive, &poses, &compiling}) CHECK(!task->is_between_poses());
  for (const FrameTask* task : {&drive, &poses, &between}) {
    CHECK(!task->only_compiles());
    CHECK(task->frame() == 7);
    CHECK(task->pose().time_s == 3);
    CHECK(!task->is_timed());
  }
  CHECK(between.is_between_poses());
  CHECK(compiling.only_compiles());
  CHECK(compiling.pose().time_s == 5);
  CHECK(compiling.names().transmitter(0).empty());
}

TEST_CASE("the names of a frame are those of the configuration's ends") {
  Config config;
  config.transmitters.resize(1);
  config.receivers.resize(2);
  config.transmitters[0].name = "mast";
  config.receivers[1].name = "car";
  const FrameNames names = FrameNames::of(config);
  CHECK(names.transmitter(0) == "mast");
  CHECK(names.receiver(1) == "car");
}
