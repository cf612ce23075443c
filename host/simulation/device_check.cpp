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
  DeviceCheck(gpu::Context& context, const CheckedFeatures& features, std::set<std::string>* kernels)
      : context_(context), features_(features), kernels_(kernels) {}

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
    note_kernels();
  }

  void check_a_frame() {
    stage_ = "paths";
    FrameLoop frames(*setup_);
    const FrameResult first = run(frames);
    add(check_sequences(*setup_, first));
    add(check_paths(first, features_));
    add(check_fields(*setup_, first));
    if (setup_->cache) {
      stage_ = "ray cache";
      add(check_cached(first, run(frames)));
    }
    if (setup_->plan->reuse) {
      stage_ = "reuse";
      add(check_reused(first, run(frames)));
    }
    if (features_.sums) {
      stage_ = "links";
      frames.sum_links(true);
      add(check_sums_of_links(first, run(frames), setup_->plan->asked.radio.frequency_hz));
    }
  }

  // Each frame forgets which kernels ran before it.
  void note_kernels() {
    if (!kernels_) return;
    context_.profile();
    for (const auto& [name, time] : context_.kernel_times()) kernels_->insert(name);
  }

  FrameResult run(FrameLoop& frames) {
    FrameResult out = frames.run(FrameTask::of_drive(
        {.frame = 0, .pose = [&] { return check_state(setup_->plan->world); }, .names = FrameNames::none()}));
    note_kernels();
    return out;
  }

  gpu::Context& context_;
  const CheckedFeatures& features_;
  std::set<std::string>* kernels_;  // may be null
  std::optional<Setup> setup_;
  std::string stage_;
  Stopwatch watch_;
  std::vector<CheckResult> results_;
};

}  // namespace

std::vector<CheckResult> check_device(gpu::Context& context, const CheckedFeatures& features,
                                      std::set<std::string>* kernels) {
  std::vector<CheckResult> out = DeviceCheck(context, features, kernels)();
  context.set_profiling(true);
  context.reset_profile();
  return out;
}

}  // namespace wavetracer
