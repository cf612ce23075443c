// SPDX-License-Identifier: Apache-2.0
// The row of a kernel is about the frame of the median time, so that its elements and its time belong together.
#include "frame_kernels.hpp"

#include <algorithm>
#include <set>

#include "frame_worlds.hpp"
#include "kernel_costs.hpp"
#include "passes/tuning.hpp"
#include "scene/load.hpp"

namespace wavetracer::bench {
namespace {

// A kernel in one frame.
struct Sample {
  double elements, seconds, launches;
  KernelWork work;
};

class FrameKernels {
 public:
  FrameKernels(KernelRows& rows, const FrameOptions& options) : rows_(rows), options_(options) {}

  void run() {
    for (const FrameWorld& world :
         frame_worlds(options_.shared, options_.rays, options_.vehicles, static_cast<uint32_t>(rows_.runs()) + 1)) {
      if (!options_.worlds.empty() && std::ranges::count(options_.worlds, world.name) == 0) continue;
      worlds_.insert(world.name);
      if (std::ranges::any_of(kernel_costs(), [&](const KernelCost& cost) { return belongs(cost, world); }))
        measure(world);
    }
  }

  const std::set<std::string>& ran() const { return ran_; }

 private:
  KernelRows& rows_;
  const FrameOptions& options_;
  std::set<std::string> ran_, worlds_;  // worlds_: those measured so far

  bool belongs(const KernelCost& cost, const FrameWorld& world) const {
    if (!rows_.wants(cost.kernel)) return false;
    return cost.world == world.name ||
           (!rows_.has(cost.kernel) && (cost.world.empty() || worlds_.contains(std::string(cost.world))));
  }

  void measure(const FrameWorld& world) {
    Simulation simulation(world.config, options_.device);
    simulation.sum_links(!world.config.output.paths);
    const size_t triangles = load_scene(world.config).triangles.size();
    const Tuning tuning = tuning_of(rows_.info());
    std::map<std::string_view, std::vector<Sample>> first, later;
    for (uint32_t run = 0; run <= rows_.runs(); ++run) {
      const FrameResult frame = simulation.run_frame(world.frames > 1 ? run % world.frames : 0);
      const FrameNumbers numbers{frame, world.config, triangles, tuning};
      for (const auto& [kernel, time] : frame.kernels) ran_.insert(kernel);
      for (const KernelCost& cost : kernel_costs()) {
        const auto time = frame.kernels.find(std::string(cost.kernel));
        if (time == frame.kernels.end() || !belongs(cost, world)) continue;
        const KernelWork work{.bytes = cost.bytes(numbers),
                              .operations = cost.operations(numbers),
                              .in_double = cost.in_double,
                              .gathers = cost.gathers,
                              .slots = cost.slots};
        (run == 0 ? first : later)[cost.kernel].push_back(
            {cost.elements(numbers), time->second.seconds, static_cast<double>(time->second.launches), work});
      }
    }
    for (const KernelCost& cost : kernel_costs()) {  // growing the set of sequences happens in the first frame only
      const auto& samples = later.contains(cost.kernel) ? later : first;
      if (const auto found = samples.find(cost.kernel); found != samples.end()) print(cost, world, found->second);
    }
  }

  void print(const KernelCost& cost, const FrameWorld& world, const std::vector<Sample>& samples) {
    std::vector<double> seconds;
    for (const Sample& sample : samples) seconds.push_back(sample.seconds);
    const Sample& s = *std::ranges::find(samples, median(seconds), &Sample::seconds);
    rows_.print({.kernel = std::string(cost.kernel),
                 .variant = "frame of " + world.name,
                 .element = std::string(cost.element),
                 .elements = s.elements,
                 .seconds = s.seconds,
                 .launches = s.launches,
                 .work = s.work,
                 .samples = samples.size()});
  }
};

}  // namespace

std::set<std::string> measure_frame_kernels(KernelRows& rows, const FrameOptions& options) {
  FrameKernels frames(rows, options);
  frames.run();
  return frames.ran();
}

}  // namespace wavetracer::bench
