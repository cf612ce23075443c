// SPDX-License-Identifier: Apache-2.0
// Tests the list of stages: sums over parts, unique names, and unlisted stages.
// All tests of frames show that every stage is listed, since a frame with another stage fails.
#include "wavetracer/stages.hpp"
#include <doctest/doctest.h>
#include <set>

using namespace wavetracer;

TEST_CASE("a stage stands in the list once, and belongs to one part") {
  std::set<std::string_view> names;
  for (const FrameStage& stage : frame_stages) names.insert(stage.name);
  CHECK(names.size() == frame_stages.size());
  REQUIRE(find_frame_stage("trace_moving"));
  CHECK(find_frame_stage("trace_moving")->part == FramePart::discovery);
  CHECK(find_frame_stage("trace_movin") == nullptr);
}

TEST_CASE("parts add up to all stages") {
  StageSeconds seconds;
  double all = 0, value = 1, sum = 0;
  for (const FrameStage& stage : frame_stages) {
    seconds[std::string(stage.name)] = value;
    all += value;
    value *= 2;  // so that no other stages have the same sum
  }
  for (const FramePart part :
       {FramePart::whole, FramePart::world, FramePart::order, FramePart::discovery, FramePart::cache,
        FramePart::reception, FramePart::paths, FramePart::fields, FramePart::transfer})
    sum += part_seconds(seconds, part);
  CHECK(sum == all);
  CHECK(part_seconds({{"order", 2}, {"sort", 3}, {"trace", 5}}, FramePart::order) == 5);
  CHECK(stage_seconds({{"order", 2}}, Stage::sort) == 0);
}

TEST_CASE("a stage that is not listed is a mistake in the program") {
  CHECK_NOTHROW(check_stages({{"trace", 1}, {"frame", 2}}));
  CHECK_THROWS_WITH_AS(check_stages({{"trace", 1}, {"trase", 2}}),
                       doctest::Contains("the stage \"trase\" is missing in include/wavetracer/stages.hpp"),
                       std::logic_error);
}
