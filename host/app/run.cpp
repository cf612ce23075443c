// `wavetracer run`: config in, paths out.
// The checks that need no device come first, so that a mistake costs no time; outputs are written at the end, whole.
#include <fmt/format.h>
#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include "app/commands.hpp"
#include "app/inputs.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "config/config_file.hpp"
#include "output/median.hpp"
#include "output/output.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string file, directory, frames, device;
  std::vector<std::string> sets;
  uint32_t repeat = 1;
  bool resume = false;
};

// The result of the last repeat with the median time of each stage; `repeated` is how many there were.
// An interrupt ends it after the repeat in progress.
FrameResult solve(Simulation& simulation, uint32_t repeats, Progress& progress, uint32_t& repeated) {
  FrameResult result;
  std::map<std::string, std::vector<double>> samples;
  for (repeated = 0; repeated < repeats && !interrupted(); ++repeated) {
    progress.bar("frame 0", repeated, repeats);
    FrameResult next = simulation.run_frame(0);
    if (repeated > 0 && next.counts.paths != result.counts.paths)
      next.warnings.push_back(
          fmt::format("repeat {} found {} paths, the one before {}: the device is not to be trusted", repeated,
                      next.counts.paths, result.counts.paths));
    for (const auto& [stage, seconds] : next.seconds) samples[stage].push_back(seconds);
    next.warnings.insert(next.warnings.begin(), result.warnings.begin(), result.warnings.end());
    result = std::move(next);
  }
  for (const auto& [stage, values] : samples) result.seconds[stage] = median(values);
  std::sort(result.warnings.begin(), result.warnings.end());
  result.warnings.erase(std::unique(result.warnings.begin(), result.warnings.end()), result.warnings.end());
  return result;
}

Config configuration(const Options& options) {
  if (options.resume)
    throw ConfigError("--resume: nothing to resume, because a run without trajectories is one frame; leave it out");
  if (!options.frames.empty() && options.frames != "0:0")
    throw ConfigError(fmt::format("--frames {}: a run without trajectories has frame 0 only; leave it out or give 0:0",
                                  options.frames));
  Config config = load_config(options.file, options.sets);
  if (!options.directory.empty()) {
    config.output.directory = fs::absolute(options.directory).lexically_normal().string();
    config.text = resolved_config(config);
  }
  return config;
}

void run(const Options& options, Invocation& invocation) {
  const Config config = configuration(options);
  check_inputs(config);
  check_output_folder(config.output.directory);
  catch_interrupts();
  Progress progress;
  progress.line("loading the scene, compiling the kernels");
  Simulation simulation(config, options.device);
  const DeviceSummary device = simulation.device();
  const StageSeconds setup = simulation.setup_seconds();
  double ready = 0;
  for (const auto& [stage, seconds] : setup) ready += seconds;
  progress.line(fmt::format("ready after {:.2f} s on {}; {} rays from each transmitter ({})", ready, device.name,
                            config.trace.rays, config.transmitters.size()));

  RunData data{config, simulation.scene(), {}, {}, 0, {}};
  data.summary.device = device;
  data.summary.order = simulation.order();
  data.summary.setup_seconds = setup;
  data.summary.command_line = invocation.command_line;
  data.summary.warnings = simulation.scene().report.warnings;
  FrameResult frame = solve(simulation, options.repeat, progress, data.summary.repeat_count);
  if (interrupted()) invocation.code = ExitCode::interrupted;
  if (data.summary.repeat_count == 0) {
    progress.line("interrupted before the first frame; nothing was written");
    return;
  }
  data.frames.push_back(std::move(frame));
  for (const auto* warnings : {&data.summary.warnings, &data.frames.front().warnings})
    for (const std::string& warning : *warnings) progress.line("warning: " + warning);

  progress.line("writing to " + config.output.directory);
  std::cout << report(data, write_outputs(config.output.directory, data)) << std::flush;
  if (interrupted()) {
    invocation.code = ExitCode::interrupted;
    progress.line(fmt::format("interrupted; what is written is whole, after {} of {} repeats",
                              data.summary.repeat_count, options.repeat));
  }
}

}  // namespace

void add_run(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand("run", "Trace a config and write its paths");
  const auto options = std::make_shared<Options>();
  command->add_option("-c,--config", options->file, "Config file (TOML)")->required();
  command->add_option("-o,--output", options->directory, "Folder for the results, instead of output.directory");
  command->add_option("--set", options->sets, "KEY=VALUE over the file; may be repeated")->allow_extra_args(false);
  command->add_option("--frames", options->frames, "First and last frame, A:B");
  command->add_option("--device", options->device, "Index, or part of a platform's or device's name");
  command->add_option("--repeat", options->repeat, "Solve each frame N times and report the median times")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--resume", options->resume, "Go on with an interrupted run");
  command->footer([] { return field_help(); });
  command->callback([options, &invocation] { run(*options, invocation); });
}

}  // namespace wavetracer::app
