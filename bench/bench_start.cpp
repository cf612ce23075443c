// SPDX-License-Identifier: Apache-2.0
// bench_start measures the seconds from the start of `wavetracer run` to its first kernel, with empty caches and on
// later starts. It needs POSIX, and the program's line "ready after" on standard error, printed when its kernels are
// built and none has run.
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>

#include "json_line.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

extern char** environ;

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;

constexpr double target_s = 0.3;  // limit of a second start

// Four blocks of houses and one link load quickly, so that the program's own start shows.
constexpr const char* config_text = R"([scene]
generate = "--seed 1 --blocks 2x2"
[trace]
rays = 1000
[[transmitter]]
name = "tx"
position_m = [0.0, 0.0, 6.0]
[[receiver]]
name = "rx"
position_m = [60.0, 0.0, 1.5]
)";

struct Start {
  double ready_s = 0, whole_s = 0;       // from the start to the first kernel, and to the program's end
  std::map<std::string, double> stages;  // stages of the time to the first kernel
  std::string device;
};

// Starts the program with its standard error in a pipe, and calls on_line for each line when it arrives.
template <class OnLine>
int spawn(std::vector<std::string> words, OnLine on_line) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw RuntimeError("cannot make a pipe: too many open files?");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  pid_t process = 0;
  const int failed = posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  const std::unique_ptr<FILE, int (*)(FILE*)> lines(fdopen(ends[0], "r"), fclose);
  if (failed) throw RuntimeError(fmt::format("cannot start {}; --program names it", words[0]));
  char* line = nullptr;
  size_t size = 0;
  while (getline(&line, &size, lines.get()) > 0) on_line(std::string(line));
  free(line);
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Start start_once(const std::vector<std::string>& words, const std::string& summary_file) {
  Start result;
  std::string messages;
  const auto launched = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - launched).count();
  };
  const int code = spawn(words, [&](const std::string& line) {
    if (line.starts_with("ready after")) result.ready_s = elapsed();
    messages += line;
  });
  result.whole_s = elapsed();
  if (code != 0 || result.ready_s == 0)
    throw RuntimeError(fmt::format("{} ended with {} and said\n{}", words[0], code, messages));
  const auto summary = nlohmann::json::parse(std::ifstream(summary_file));
  result.device = summary.at("device");
  for (const char* stage : {"device", "load", "build", "compile", "device check"}) {
    const auto& seconds = summary.at("seconds");
    if (seconds.contains(stage)) result.stages[stage] = seconds.at(stage);
  }
  return result;
}

void print_start(const std::string& name, const Start& start, bool has_target, const std::string& command) {
  Result result{"start", name, start.device, start.ready_s, "s", Better::lower, "", {}, 0, ""};
  if (has_target) {
    result.baseline = "target";
    result.baseline_value = target_s;
  }
  result.detail = fmt::format("whole process {:.3f} s;", start.whole_s);
  for (const auto& [stage, seconds] : start.stages) {
    result.detail += fmt::format(" {} {:.3f}", stage, seconds);
    result.extra[stage + "_s"] = seconds;
  }
  result.extra["whole_s"] = start.whole_s;
  print(result, command);
}

struct Options {
  std::string device, program;
  size_t runs = 9;
};

// The program is beside this one, as in a bundle, or at its place in a build folder.
std::string find_program(const std::string& given) {
  if (!given.empty()) return given;
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& place : {here / "wavetracer", here.parent_path() / "host" / "app" / "wavetracer"})
    if (fs::exists(place)) return place.string();
  throw ConfigError("wavetracer is not beside bench_start and not in its build folder; --program names it");
}

void run(const Options& options, const std::string& command) {
  const test::TemporaryFolder folder;
  const std::string config = folder / "start.toml", output = folder / "out";
  std::ofstream(config) << config_text;
  // Caches of this program, of PoCL and of NVIDIA's driver are empty at the first start, which fills them for the later
  // ones.
  for (const auto& [variable, name] :
       {std::pair{"XDG_CACHE_HOME", "cache"}, {"POCL_CACHE_DIR", "pocl"}, {"CUDA_CACHE_PATH", "cuda"}}) {
    fs::create_directory(folder / name);
    setenv(variable, (folder / name).c_str(), 1);
  }
  std::vector<std::string> words{find_program(options.program), "run", "-c", config, "-o", output};
  if (!options.device.empty()) words.insert(words.end(), {"--device", options.device});
  const std::string summary = (fs::path(output) / "summary.json").string();

  print_start("first start, empty caches", start_once(words, summary), false, command);
  std::vector<Start> starts;
  for (size_t i = 0; i < options.runs; i++) starts.push_back(start_once(words, summary));
  const auto middle = starts.begin() + static_cast<std::ptrdiff_t>(starts.size() / 2);
  std::nth_element(starts.begin(), middle, starts.end(),
                   [](const Start& a, const Start& b) { return a.ready_s < b.ready_s; });
  print_start("second start, programs cached", *middle, true, command);
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Seconds from the launch of wavetracer run to its first kernel");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--program", options.program, "the wavetracer to start; default: beside this program");
  app.add_option("--runs", options.runs, "starts with filled caches, of which the median counts")
      ->check(CLI::Range(1, 1000));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_start: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
