// SPDX-License-Identifier: Apache-2.0
// Single kernels are checked first, so that a later failure has another cause.
#include "simulation/device_check.hpp"

#include <exception>
#include <new>
#include <optional>

#include "simulation/check_frame.hpp"
#include "simulation/check_lists.hpp"
#include "simulation/check_traversal.hpp"
#include "simulation/check_world.hpp"

namespace wavetracer {
namespace {

class DeviceCheck {
 public:
  DeviceCheck(gpu::Context& context, const CheckedFeatures& features) : context_(context), features_(features) {}

  std::vector<CheckResult> operator()() {
    try {
      check_kernels();
      check_a_frame();
    } catch (const std::bad_alloc&) {
      throw;  // this does not concern the device
    } catch (const std::exception& error) {
      results_.push_back({stage_, false, error.what(), watch_.lap()});
    }
    return std::move(results_);
  }

 private:
  void add(CheckResult result) {
    result.seconds = watch_.lap();
    results_.push_back(std::move(result));
  }

  void check_kernels() {
    watch_.lap();
    stage_ = "sorts";
    add(check_sorts(context_));
    stage_ = "sums";
    add(check_sums(context_));
    stage_ = "traversal";
    const Config config = check_config(features_);
    setup_.emplace(make_setup(context_, config, check_scene(config), features_.reuse));
    const WorldState state = check_state(setup_->plan->world);
    if (setup_->placement) setup_->placement->place(setup_->device_scene, state.instances);
    add(check_traversal(*setup_, state));
  }

  void check_a_frame() {
    stage_ = "paths";
    FrameLoop frames(*setup_);
    const FrameResult first = run(frames);
    add(check_sequences(*setup_, first));
    add(check_paths(first, features_));
    add(check_fields(*setup_, first));
    if (!setup_->cache) return;
    stage_ = "ray cache";
    add(check_cached(first, run(frames)));
  }

  FrameResult run(FrameLoop& frames) {
    return frames.run(FrameTask::of_drive(
        {.frame = 0, .pose = [&] { return check_state(setup_->plan->world); }, .names = FrameNames::none()}));
  }

  gpu::Context& context_;
  const CheckedFeatures& features_;
  std::optional<Setup> setup_;
  std::string stage_;
  Stopwatch watch_;
  std::vector<CheckResult> results_;
};

}  // namespace

std::vector<CheckResult> check_device(gpu::Context& context, const CheckedFeatures& features) {
  std::vector<CheckResult> out = DeviceCheck(context, features)();
  context.set_profiling(true);
  context.reset_profile();
  return out;
}

}  // namespace wavetracer
