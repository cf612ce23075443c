// SPDX-License-Identifier: Apache-2.0
// bench_frame_kernels measures every kernel in the frames that need it, and compares it with the least time that its
// bytes, its operations and its launches allow on this device. The machine must be quiet. Times are those of the
// kernels by the device's clock. A time below that of its bytes means that they came from a cache, which the copy that
// bytes are measured with misses. "error" of the last row counts kernels that ran and have no row; the others have
// none.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <set>

#include "device_limits.hpp"
#include "frame_worlds.hpp"
#include "json_line.hpp"
#include "kernel_costs.hpp"
#include "scene/load.hpp"
#include "timing.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  std::vector<std::string> worlds;
  size_t runs = 7, vehicles = 0;  // 0 means 100 on GPUs, 20 on CPUs
  uint64_t rays = 0;              // 0 means 10^6 on GPUs, 10^5 on CPUs
};

// A kernel in one frame.
struct Sample {
  double elements, seconds, bytes, operations, launches;
};

// Sorts have their own program, with peers.
bool is_of_a_sort(std::string_view kernel) {
  return kernel.starts_with("radix_sort") || kernel.starts_with("bitonic_sort");
}

class Bench {
 public:
  Bench(const Options& options, std::string command) : options_(options), command_(std::move(command)) {
    gpu::Context context(options.device);
    info_ = context.info();
    limits_ = measure_limits(context, options.runs);
  }

  void run() {
    const std::vector<FrameWorld> worlds = frame_worlds(options_.shared,
                                                        options_.rays ? options_.rays
                                                        : info_.cpu   ? 100'000
                                                                      : 1'000'000,
                                                        options_.vehicles ? options_.vehicles
                                                        : info_.cpu       ? 20
                                                                          : 100,
                                                        static_cast<uint32_t>(options_.runs) + 1);
    for (const FrameWorld& world : worlds)
      if (options_.worlds.empty() || std::ranges::count(options_.worlds, world.name)) measure(world);
    if (options_.worlds.empty()) print_coverage();
  }

 private:
  using Samples = std::map<std::string_view, std::vector<Sample>>;

  void measure(const FrameWorld& world) {
    Simulation simulation(world.config, options_.device);
    const size_t triangles = load_scene(world.config).triangles.size();
    worlds_.insert(world.name);
    Samples first, later;
    for (uint32_t run = 0; run <= options_.runs; ++run) {
      const FrameResult frame = simulation.run_frame(world.frames > 1 ? run % world.frames : 0);
      const FrameNumbers numbers{frame, world.config, triangles};
      for (const auto& [kernel, time] : frame.kernels) ran_.insert(kernel);
      for (const KernelCost& cost : kernel_costs()) {
        const auto time = frame.kernels.find(std::string(cost.kernel));
        if (time == frame.kernels.end() || !belongs(cost, world)) continue;
        (run == 0 ? first : later)[cost.kernel].push_back({cost.elements(numbers), time->second.seconds,
                                                           cost.bytes(numbers), cost.operations(numbers),
                                                           static_cast<double>(time->second.launches)});
      }
    }
    for (const KernelCost& cost : kernel_costs()) {  // growing the set of sequences happens in the first frame only
      const Samples& samples = later.contains(cost.kernel) ? later : first;
      if (const auto found = samples.find(cost.kernel); found != samples.end()) print_row(cost, world, found->second);
    }
  }

  bool belongs(const KernelCost& cost, const FrameWorld& world) const {
    return cost.world == world.name || (!printed_.contains(std::string(cost.kernel)) &&
                                        (cost.world.empty() || worlds_.contains(std::string(cost.world))));
  }

  void print_row(const KernelCost& cost, const FrameWorld& world, const std::vector<Sample>& samples) {
    std::vector<double> seconds;
    for (const Sample& sample : samples) seconds.push_back(sample.seconds);
    const double middle = median(seconds);
    const Sample& s = *std::ranges::find(samples, middle, &Sample::seconds);
    const std::pair<double, const char*> bounds[] = {
        {s.elements * s.bytes / limits_.bytes_s, "bytes"},
        {s.elements * s.operations / (cost.in_double ? limits_.doubles_s : limits_.singles_s), "operations"},
        {s.launches * limits_.launch_s, "launches"}};
    const auto& [bound_s, what] = *std::ranges::max_element(bounds);
    Result result;
    result.bench = "frame_kernels";
    result.name = fmt::format("{}, {}", cost.kernel, world.name);
    result.device = info_.name;
    result.value = s.seconds * 1e3;
    result.unit = "ms per frame";
    result.better = Better::lower;
    result.baseline = fmt::format("its {}", what);
    result.baseline_value = bound_s * 1e3;
    result.detail =
        fmt::format("{:.4g} {} in {:.0f} launches; {:.4g} B and {:.4g} operations{} each; {:.4g} M elements/s",
                    s.elements, cost.element, s.launches, s.bytes, s.operations, cost.in_double ? " in double" : "",
                    s.elements / s.seconds * 1e-6);
    result.extra = {{"elements", s.elements},          {"launches", s.launches},        {"bytes_s", bounds[0].first},
                    {"operations_s", bounds[1].first}, {"launches_s", bounds[2].first}, {"samples", samples.size()}};
    print(result, command_);
    printed_.insert(std::string(cost.kernel));
  }

  void print_coverage() {
    std::string without;
    size_t count = 0;
    for (const std::string& kernel : ran_) {
      if (is_of_a_sort(kernel) || printed_.contains(kernel)) continue;
      without += " " + kernel;
      ++count;
    }
    if (count > 0) fmt::print(stderr, "bench_frame_kernels: no row for{}\n", without);
    Result result;
    result.bench = "frame_kernels";
    result.name = "kernels with a row";
    result.device = info_.name;
    result.value = static_cast<double>(printed_.size());
    result.unit = "kernels";
    result.error = static_cast<double>(count);
    result.exact = true;
    result.detail =
        fmt::format("copy {:.4g} GB/s, {:.4g} G operations/s in float, {:.4g} in double, {:.3g} us per launch",
                    limits_.bytes_s * 1e-9, limits_.singles_s * 1e-9, limits_.doubles_s * 1e-9, limits_.launch_s * 1e6);
    print(result, command_);
  }

  const Options& options_;
  std::string command_;
  gpu::DeviceInfo info_;
  DeviceLimits limits_;
  std::set<std::string> ran_, printed_, worlds_;  // worlds_: those measured so far
};

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Every kernel in the frames that need it, beside the least time that the device allows");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich");
  app.add_option("--world", options.worlds, "only these, several with commas")->delimiter(',');
  app.add_option("--rays", options.rays, "per transmitter; default: 10^5 on CPUs, 10^6 elsewhere");
  app.add_option("--vehicles", options.vehicles, "of the drive; default: 20 on CPUs, 100 elsewhere");
  app.add_option("--runs", options.runs, "frames of which the median counts")->check(CLI::Range(3, 1000));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::Bench(options, bench::command_line(argc, argv)).run();
  } catch (const Error& error) {
    fmt::print(stderr, "bench_frame_kernels: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
