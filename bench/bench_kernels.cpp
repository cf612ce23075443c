// SPDX-License-Identifier: Apache-2.0
// bench_kernels measures every kernel of the suite beside the least time that its bytes, its random accesses, its
// operations and its launches allow on this device: alone where it needs no frame, and in a frame that has it. The
// machine must be quiet. "error" counts wrong results of the cases that are compared with others. A time below that of
// its bytes means that they came from a cache, which the copy that bytes are measured with misses.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "frame_kernels.hpp"
#include "kernel_costs.hpp"
#include "scene_kernels.hpp"
#include "small_kernels.hpp"
#include "sort_kernels.hpp"
#include "suite_kernels.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

// Zeros are numbers that suit the device.
struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  std::vector<std::string> kernels, worlds;
  size_t runs = 7, vehicles = 0;
  uint32_t n = 0;
  uint64_t rays = 0;
  bool list = false;
};

// The names of all kernels that this program measures.
std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const KernelCost& cost : kernel_costs()) names.emplace_back(cost.kernel);
  names.insert(names.end(), sort_kernels().begin(), sort_kernels().end());
  std::ranges::sort(names);
  names.erase(std::ranges::unique(names).begin(), names.end());
  return names;
}

// Throws InputError for a name that is neither a kernel's nor a program's.
std::set<std::string, std::less<>> wanted_kernels(const std::vector<std::string>& given) {
  const std::vector<std::string> names = kernel_names();
  std::set<std::string, std::less<>> wanted;
  for (const std::string& text : given) {
    const size_t before = wanted.size();
    for (const std::string& name : names)
      if (name == text || name.starts_with(text + "/")) wanted.insert(name);
    if (wanted.size() == before && !wanted.contains(text))
      throw InputError(fmt::format("{} is no kernel; bench_kernels --list prints all of them", text));
  }
  return wanted;
}

// Measures one part of the rows; a part that fails, on this device or by a wrong result, loses its further rows only.
template <class Measure>
bool part(const char* name, const Measure& measure) {
  try {
    measure();
    return true;
  } catch (const Error& error) {
    fmt::print(stderr, "bench_kernels: {}: {}\n", name, error.what());
    return false;
  }
}

bool run(const Options& options, const std::string& command) {
  const auto wanted = wanted_kernels(options.kernels);
  gpu::DeviceInfo info;
  DeviceLimits limits;
  {
    gpu::Context context(options.device);
    info = context.info();
    limits = measure_limits(context, options.runs);
  }
  const uint32_t n = options.n ? options.n : 1u << (info.cpu ? 22 : 26);
  const uint64_t rays = options.rays ? options.rays : info.cpu ? 100'000 : 1'000'000;
  const size_t vehicles = options.vehicles ? options.vehicles : info.cpu ? 20 : 100;
  KernelRows rows(info, limits, wanted, options.runs, command);
  bool complete = true;
  if (options.worlds.empty()) {
    complete &= part("small kernels", [&] {
      gpu::Context context(options.device);
      measure_small_kernels(rows, context, n);
    });
    complete &= part("kernels of the suite", [&] {
      gpu::Context context(options.device);
      measure_suite_kernels(rows, context, n, static_cast<uint32_t>(4 * rays));
    });
    complete &= part("sorts", [&] {
      gpu::Context context(options.device);
      measure_sort_kernels(rows, context, n);
    });
    complete &= part("kernels of a scene", [&] {
      gpu::Context context(options.device);
      measure_scene_kernels(rows, context, options.shared, static_cast<uint32_t>(4 * rays),
                            static_cast<uint32_t>(10 * vehicles));
    });
  }
  complete &= part("frames", [&] {
    const std::vector<std::string> names = kernel_names();
    const FrameOptions frames{options.device, options.shared, options.worlds, rays, vehicles};
    for (const std::string& kernel : measure_frame_kernels(rows, frames)) {
      if (std::ranges::binary_search(names, kernel)) continue;
      fmt::print(stderr, "bench_kernels: {} ran in a frame, and kernel_costs.cpp lacks it\n", kernel);
      complete = false;
    }
  });
  if (wanted.empty() && options.worlds.empty()) rows.print_coverage(kernel_names());
  return complete;
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Every kernel beside the least time that the device allows");
  bench::Options options;
  app.add_option("kernels", options.kernels, "only these, such as scan or refine/mark; default: all");
  app.add_flag("--list", options.list, "print the names of all kernels, and measure none");
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich");
  app.add_option("--world", options.worlds, "only frames of these worlds, several with commas")->delimiter(',');
  app.add_option("--runs", options.runs, "timed runs of which the median counts")->check(CLI::Range(3, 1000));
  app.add_option("--n", options.n, "elements outside of frames; default: 2^22 on CPUs, 2^26 elsewhere")
      ->check(CLI::Range(1 << 16, 1 << 28));
  app.add_option("--rays", options.rays, "per transmitter in frames; default: 10^5 on CPUs, 10^6 elsewhere");
  app.add_option("--vehicles", options.vehicles, "of the drive; default: 20 on CPUs, 100 elsewhere");
  CLI11_PARSE(app, argc, argv);
  try {
    if (options.list) {
      for (const std::string& name : bench::kernel_names()) fmt::print("{}\n", name);
      return 0;
    }
    return bench::run(options, bench::command_line(argc, argv)) ? 0 : 1;
  } catch (const Error& error) {
    fmt::print(stderr, "bench_kernels: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
