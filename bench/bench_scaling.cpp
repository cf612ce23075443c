// SPDX-License-Identifier: Apache-2.0
// bench_scaling measures frames per second of a drive on 1, 2, 4, ... devices of a host, or on CPUs with 1 process on 1
// core and 2 processes on 2 cores. It only needs the program: city and traffic are generated.
// It needs POSIX, util-linux's taskset for CPUs, and the program's lines "ready after" and "writing to" on stderr.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>

#include "json_line.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string program, device_kind, devices_list;  // device_kind: empty if this machine decides
  std::vector<uint32_t> counts;
  double seconds = 25;  // wanted duration of the run on one device
  uint64_t rays = 50000;
  uint32_t frames = 0, vehicles = 100, shard_frames = 5;
};

// {} are seconds of traffic, shard_frames, rays, vehicles. There are 10 frames a second.
constexpr const char* config_text = R"(scene.generate = "--seed 1 --blocks 6x6"
trajectories.generate = "--seed 1 --blocks 6x6 --vehicles {3} --seconds {0} --step 0.1"
time.step_s = 0.1
output.shard_frames = {1}
trace.rays = {2}
trace.max_depth = 3
links.max_distance_m = 150
[[mount]]
name = "roof"
role = "both"
offset_m = [0.0, 0.0, 1.6]
)";

// Times of one command, in seconds since its start.
struct Times {
  double ready_s = 0, merging_s = 0, whole_s = 0;
  double solving_s() const { return merging_s - ready_s; }
};

std::string quoted(const std::string& text) { return "'" + text + "'"; }

// command: for the shell. ready: when the first process can trace; merging: when all frames are there.
Times timed(const std::string& command) {
  Times times;
  std::string messages;
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  FILE* const lines = popen((command + " 2>&1 >/dev/null").c_str(), "r");
  if (!lines) throw RuntimeError("cannot start " + command);
  char* line = nullptr;
  size_t size = 0;
  while (getline(&line, &size, lines) > 0) {
    const std::string text = line;
    if (times.ready_s == 0 && text.find("ready after") != std::string::npos) times.ready_s = elapsed();
    if (text.find("writing to") != std::string::npos) times.merging_s = elapsed();
    messages += text;
  }
  free(line);
  const int status = pclose(lines);
  times.whole_s = elapsed();
  if (status != 0 || times.ready_s == 0 || times.merging_s == 0)
    throw RuntimeError(fmt::format("{} ended with {} and said\n{}", command, WEXITSTATUS(status), messages));
  return times;
}

// The program is beside this one, as in a bundle, or at its place in a build folder.
std::string find_program(const std::string& given) {
  if (!given.empty()) return given;
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& place : {here / "wavetracer", here.parent_path() / "host" / "app" / "wavetracer"})
    if (fs::exists(place)) return place.string();
  throw ConfigError("wavetracer is not beside bench_scaling and not in its build folder; --program names it");
}

// Tells whether `wavetracer devices` lists a GPU: it looks for whole words of its table.
bool has_gpu(const std::string& program) {
  FILE* const table = popen((quoted(program) + " devices 2>/dev/null").c_str(), "r");
  if (!table) throw RuntimeError("cannot start " + program);
  bool found = false;
  char* line = nullptr;
  size_t size = 0;
  while (getline(&line, &size, table) > 0) found |= std::string(line).find("  GPU  ") != std::string::npos;
  free(line);
  pclose(table);
  return found;
}

class Scaling {
 public:
  Scaling(const Options& options, std::string command) : options_(options), command_(std::move(command)) {
    program_ = find_program(options.program);
    gpu_ = options.device_kind.empty() ? has_gpu(program_) : options.device_kind == "gpu";
    if (options.counts.empty()) options_.counts = gpu_ ? std::vector<uint32_t>{1, 2, 4} : std::vector<uint32_t>{1, 2};
    for (size_t at = 0; at < options.devices_list.size();) {
      devices_.push_back(options.devices_list.substr(at, options.devices_list.find(',', at) - at));
      at += devices_.back().size() + 1;
    }
    const uint32_t most = *std::ranges::max_element(options_.counts);
    for (uint32_t i = static_cast<uint32_t>(devices_.size()); gpu_ && i < most; ++i)
      devices_.push_back(std::to_string(i));
    if (gpu_ && devices_.size() < most) throw ConfigError("--devices-list names fewer devices than --counts wants");
  }

  void run() {
    const uint32_t most = *std::ranges::max_element(options_.counts), shard = options_.shard_frames;
    write_config(shard);
    timed(words(1));  // fills the caches of compiled kernels
    if (options_.frames == 0) {
      const double frame_s = timed(words(1)).solving_s() / shard;
      const auto wanted = static_cast<uint32_t>(std::clamp(options_.seconds / frame_s, 1.0, 20000.0));
      options_.frames = wanted;
    }
    // There are as many shards as all devices take in whole rounds: a remainder would count as a loss of scaling.
    const uint32_t round = shard * most * 2;
    options_.frames = std::max(round, options_.frames / round * round);
    write_config(options_.frames);
    std::optional<Times> one;
    for (const uint32_t count : options_.counts) {
      const Times times = timed(words(count));
      if (!one) one = times;
      report(count, times, *one);
    }
  }

 private:
  Options options_;
  std::string command_, program_;
  bool gpu_ = false;
  std::vector<std::string> devices_;
  test::TemporaryFolder folder_;

  void write_config(uint32_t frames) const {
    std::ofstream(folder_ / "drive.toml") << fmt::format(fmt::runtime(config_text), (frames - 1) / 10.0,
                                                         options_.shard_frames, options_.rays, options_.vehicles);
  }

  // One device is run as a user would run it: without --devices.
  std::string words(uint32_t count) const {
    const std::string run =
        fmt::format("{} run -c {} -o {}", quoted(program_), quoted(folder_ / "drive.toml"), quoted(folder_ / "out"));
    if (gpu_) {
      const auto list = std::vector(devices_.begin(), devices_.begin() + count);
      return count == 1 ? run + " --device " + list[0] : fmt::format("{} --devices {}", run, fmt::join(list, ","));
    }
    const std::string device = devices_.empty() ? "" : " --device " + devices_[0];
    return fmt::format("taskset -c 0-{} {}{}{}", count - 1, run, device,
                       count == 1 ? "" : fmt::format(" --processes {}", count));
  }

  void report(uint32_t count, const Times& times, const Times& one) const {
    const auto summary = nlohmann::json::parse(std::ifstream(folder_ / "out" + "/summary.json"));
    const double frames = options_.frames, first = options_.counts.front(), more = count / first;
    Result result{"scaling",
                  fmt::format("drive, {} vehicles, {} rays, {} {}", options_.vehicles, options_.rays, count,
                              gpu_ ? (count == 1 ? "device" : "devices") : (count == 1 ? "core" : "cores")),
                  summary.at("device"),
                  frames / times.whole_s,
                  "frames/s",
                  Better::higher,
                  "",
                  {},
                  0,
                  ""};
    const double whole = one.whole_s / times.whole_s / more, solving = one.solving_s() / times.solving_s() / more;
    if (count != options_.counts.front()) {
      result.baseline = fmt::format("{} times that of {}", more, options_.counts.front());
      result.baseline_value = more * frames / one.whole_s;
    }
    result.detail =
        fmt::format("efficiency {:.0f}% of the whole command, {:.0f}% of solving; start {:.1f} s, merging {:.1f} s",
                    100 * whole, 100 * solving, times.ready_s, times.whole_s - times.merging_s);
    result.extra = {{"processes", count},
                    {"frames", options_.frames},
                    {"paths", summary.at("counts").at("paths")},
                    {"whole_s", times.whole_s},
                    {"ready_s", times.ready_s},
                    {"solving_s", times.solving_s()},
                    {"merging_s", times.whole_s - times.merging_s},
                    {"efficiency_whole", whole},
                    {"efficiency_solving", solving}};
    print(result, command_);
  }
};

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  unsetenv("POCL_AFFINITY");  // the variable binds PoCL's threads to the first cores, outside of taskset's
  CLI::App app("Frames a second of a drive on 1, 2, 4, ... devices");
  bench::Options options;
  app.add_option("--program", options.program, "the wavetracer to run; default: beside this program");
  app.add_option("--device-kind", options.device_kind,
                 "gpu: a process per device; cpu: a process per core; default: gpu where there is one")
      ->check(CLI::IsMember({"cpu", "gpu"}));
  app.add_option("--devices-list", options.devices_list,
                 "indices, as `wavetracer devices` counts them; default 0,1,...");
  app.add_option("--counts", options.counts, "numbers of devices or cores; the first is the baseline")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024));
  app.add_option("--seconds", options.seconds, "wanted of the run on one device")->check(CLI::PositiveNumber);
  app.add_option("--frames", options.frames, "instead of as many as --seconds asks for");
  app.add_option("--rays", options.rays, "a transmitter");
  app.add_option("--vehicles", options.vehicles, "that drive, and talk to one another")->check(CLI::Range(2, 10000));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::Scaling(options, bench::command_line(argc, argv)).run();
  } catch (const Error& error) {
    fmt::print(stderr, "bench_scaling: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
