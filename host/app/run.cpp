// `wavetracer run`: config in, paths out.
// The checks that need no device come first, so that a mistake costs no time.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/drive.hpp"
#include "app/frame_range.hpp"
#include "app/inputs.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/solve_frame.hpp"
#include "config/config_file.hpp"
#include "gpu/hash.hpp"
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

bool has_vehicles(const Config& config) {
  return !config.trajectories.file.empty() || !config.trajectories.generate.empty() || !config.tracks.empty();
}

Config configuration(const Options& options) {
  Config config = load_config(options.file, options.sets);
  if (!has_vehicles(config)) {
    parse_frames(options.frames, 1);
    if (options.resume)
      throw ConfigError("--resume: nothing to resume, because a run without trajectories is one frame; leave it out");
  }
  if (!options.directory.empty()) {
    config.output.directory = fs::absolute(options.directory).lexically_normal().string();
    config.text = resolved_config(config);
  }
  return config;
}

RunIdentity identity_of(const Config& config, const RunSummary& summary, const FrameRange& range) {
  Config elsewhere = config;
  elsewhere.output.directory.clear();  // a folder that was moved is still that of its run
  return {summary.version, gpu::fnv1a_128(resolved_config(elsewhere)), summary.device.gpu ? "gpu" : "cpu",
          range.first,     range.last,                                 summary.repeat_count};
}

RunSummary summary_of(const Simulation& simulation, const Options& options, const FrameRange& range,
                      const std::string& command_line) {
  RunSummary summary;
  summary.device = simulation.device();
  summary.order = simulation.order();
  summary.features = simulation.features();
  summary.setup_seconds = simulation.setup_seconds();
  summary.command_line = command_line;
  summary.frames_asked = range.count();
  summary.repeat_count = options.repeat;
  summary.warnings = simulation.warnings();
  return summary;
}

// A world where nothing moves: one frame, written as it is.
Results run_still(Simulation& simulation, Run& run, Progress& progress) {
  if (interrupted()) return {};
  SolvedFrame solved = solve_frame(simulation, 0, run.summary.repeat_count);
  run.summary.repeat_count = solved.repeated;
  const FrameResult& frame = solved.result;
  progress.line("writing to " + run.config.output.directory);
  return {totals_of({&frame, 1}), 0, link_figures(frame.paths, 0, frame.world.links),
          write_outputs(run.config.output.directory, run, {&frame, 1})};
}

// What an interrupt left undone, and how to go on.
std::string unfinished(const Run& run, const Results& results, const Options& options, bool moving) {
  if (results.totals.frames == 0) return "interrupted before the first frame; nothing was written";
  if (moving)
    return fmt::format("interrupted; what is written is whole, {} of {} frames; go on with --resume",
                       results.totals.frames, run.summary.frames_asked);
  return fmt::format("interrupted; what is written is whole, after {} of {} repeats", run.summary.repeat_count,
                     options.repeat);
}

void run(const Options& options, Invocation& invocation) {
  const Config config = configuration(options);
  check_inputs(config);
  check_output_folder(config.output.directory);
  catch_interrupts();
  Progress progress;
  progress.line("loading the scene, compiling the kernels");
  Simulation simulation(config, options.device);
  const FrameRange range = parse_frames(options.frames, simulation.frame_count());
  Run run{simulation.config(), simulation.scene(), simulation.instances(), simulation.models(),
          summary_of(simulation, options, range, invocation.command_line)};
  double ready = 0;
  for (const auto& [stage, seconds] : run.summary.setup_seconds) ready += seconds;
  progress.line(fmt::format("ready after {:.2f} s on {}; {} rays from each transmitter ({})", ready,
                            run.summary.device.name, rays_in_words(config.trace), run.config.transmitters.size()));

  const bool moving = simulation.frame_count() > 1;
  if (options.resume && !moving) progress.line("--resume: nothing to go on with, because this drive has one frame");
  const Results results =
      moving ? drive(simulation, run, identity_of(config, run.summary, range), options.resume, progress)
             : run_still(simulation, run, progress);
  std::vector<std::string> warnings = run.summary.warnings;
  add_warnings(warnings, results.totals.warnings);
  for (const std::string& warning : warnings) progress.line("warning: " + warning);
  if (results.totals.frames > 0) std::cout << report(run, results) << std::flush;
  const bool whole = moving && results.totals.frames == run.summary.frames_asked;
  if (interrupted() && !whole) {
    invocation.code = ExitCode::interrupted;
    progress.line(unfinished(run, results, options, moving));
  }
}

}  // namespace

void add_run(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand("run", "Trace a config and write its paths");
  const auto options = std::make_shared<Options>();
  command->add_option("-c,--config", options->file, "Config file (TOML)")->required();
  command->add_option("-o,--output", options->directory, "Folder for the results, instead of output.directory");
  command->add_option("--set", options->sets, "KEY=VALUE over the file; may be repeated")->allow_extra_args(false);
  command->add_option("--frames", options->frames, "First and last frame, A:B, A:, :B or A; all of them if not given");
  command->add_option("--device", options->device, "Index, or part of a platform's or device's name");
  command->add_option("--repeat", options->repeat, "Solve each frame N times and report the median times")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--resume", options->resume, "Go on with a drive that was interrupted, in the same folder");
  command->footer([] { return field_help(); });
  command->callback([options, &invocation] { run(*options, invocation); });
}

}  // namespace wavetracer::app
