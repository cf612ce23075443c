// SPDX-License-Identifier: Apache-2.0
// Tests that the checks of a device pass where its kernels are right, in every known frame; stored results are used
// only for the same driver and kernels.
#include "simulation/device_check.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "simulation/check_frame.hpp"
#include "simulation/check_world.hpp"
#include "simulation/known_frames.hpp"

using namespace wavetracer;

namespace {

CheckedFeatures features_of_frame(uint32_t frame) {
  if (frame > 31) return CheckedFeatures::of(static_cast<CheckedWays>(frame - 31));
  CheckedFeatures out;
  out.diffractions = frame % 4;
  out.instances = frame / 4 & 1;
  out.transmission = frame / 8 & 1;
  out.scattering = frame / 16 & 1;
  REQUIRE(out.frame() == frame);
  return out;
}

bool check_all_pass(gpu::Context& context, const CheckedFeatures& features) {
  bool all = true;
  for (const CheckResult& result : check_device(context, features)) {
    INFO(features.words() << ": " << result.name << ": " << result.found);
    CHECK(result.passed);
    all &= result.passed;
  }
  return all;
}

}  // namespace

TEST_CASE("every known frame is what the device computes") {
  gpu::Context context;
  static_assert(known_frames.size() == 32 + checked_ways);
  for (uint32_t frame = 0; frame < known_frames.size(); ++frame) {
    CAPTURE(frame);
    const CheckedFeatures features = features_of_frame(frame);
    if (check_all_pass(context, features)) continue;  // the paths are among what was checked
    const Config config = check_config(features);
    Setup setup = make_setup(context, config, check_scene(config), false);
    FrameLoop frames(setup);
    const FrameTask task = FrameTask::of_drive(
        {.frame = 0, .pose = [&] { return check_state(setup.plan->world); }, .names = FrameNames::none()});
    const KnownFrame found = known_of(frames.run(task).paths);
    if (found == known_frames[frame]) continue;
    FAIL_CHECK(fmt::format("    {{{}, 0x{:016x}, 0x{:016x}}},", found.paths, found.sequences, found.points));
  }
}
