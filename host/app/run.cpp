// SPDX-License-Identifier: Apache-2.0
// `wavetracer run` turns a config into paths.
// The checks that need no device come first, so that a mistake is reported at once.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <sys/prctl.h>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include "app/commands.hpp"
#include "app/named_files.hpp"
#include "app/number_range.hpp"
#include "app/report.hpp"
#include "gpu/cache.hpp"
#include "jobs/devices_option.hpp"
#include "jobs/drive.hpp"
#include "jobs/earlier_run.hpp"
#include "jobs/frame_range.hpp"
#include "jobs/identity.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/process_files.hpp"
#include "jobs/progress.hpp"
#include "jobs/start.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/output.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  std::string file, directory, frames, device, devices, shard;
  std::vector<std::string> sets;
  uint32_t repeat = 1, processes = 0;
  bool resume = false, verbose = false;
  bool starts_processes() const { return !devices.empty() || processes > 0; }
};

bool has_vehicles(const Config& config) {
  return !config.trajectories.file.empty() || !config.trajectories.generate.empty() || !config.tracks.empty() ||
         !config.parked.empty();
}

// shared: by several processes, in parts that can be resumed even if there is one frame.
Config configuration(const RunOptions& options, bool shared) {
  Config config = load_config(options.file, options.sets);
  if (!config.live_vehicles.empty())
    throw ConfigError(options.file +
                      ": its [[live_vehicle]] tables need a client that sends poses: start `wavetracer serve -c " +
                      options.file + "`, or give trajectories instead of them");
  if (!has_vehicles(config)) {
    parse_frames(options.frames, 1);
    if (options.resume && !shared)
      throw ConfigError(
          "--resume: a run without trajectories has only one frame, so there is nothing to resume; "
          "leave the option out");
  }
  if (!options.directory.empty()) config.output.directory = fs::absolute(options.directory).lexically_normal().string();
  return config;
}

// Says what an interrupt left undone, and how to continue.
std::string unfinished(const Run& run, const Results& results, const RunOptions& options, bool moving) {
  if (results.totals.frames == 0) return "interrupted before the first frame; nothing was written";
  if (moving)
    return fmt::format(
        "interrupted after {} of {} frames; the written files are complete up to there; continue with --resume",
        results.totals.frames, run.summary.frames_asked);
  return fmt::format("interrupted after {} of {} repeats; the written files are complete", run.summary.repeat_count,
                     options.repeat);
}

// Returns the common job of `run --shard`: parts of one run may be written side by side.
std::string job_of(const ShardChoice& part, const RunIdentity& identity) {
  return fmt::format("{} shards of {}", part.count, identity.config);
}

void check_options(const RunOptions& options, const Ranks& ranks) {
  check_frames(options.frames);
  if (!options.devices.empty() && options.devices != "all" && !options.device.empty())
    throw ConfigError("--devices and --device both name devices; leave one of them out");
  if (options.processes > 0 && ranks.size > 1)
    throw ConfigError(
        fmt::format("--processes: this process is rank {} of {} already, which share the run by themselves; "
                    "leave out --processes",
                    ranks.rank, ranks.size));
  if (options.shard.empty()) return;
  parse_shard(options.shard);
  if (options.starts_processes())
    throw ConfigError(
        "--shard computes one part in one process; --devices and --processes start several: give one or the other");
  if (ranks.size > 1)
    throw ConfigError(
        fmt::format("--shard: this process is rank {} of {} already, which share the run by themselves; "
                    "leave out --shard",
                    ranks.rank, ranks.size));
}

// Children do the work; they get these options, without those that ask for children.
void start_children(const RunOptions& options, const Config& config, Invocation& invocation, Progress& progress) {
  ProcessPlan plan;
  plan.arguments = {"run", "-c", options.file, "-o", config.output.directory};
  for (const std::string& set : options.sets) plan.arguments.insert(plan.arguments.end(), {"--set", set});
  if (!options.frames.empty()) plan.arguments.insert(plan.arguments.end(), {"--frames", options.frames});
  if (options.resume) plan.arguments.push_back("--resume");
  if (options.verbose) plan.arguments.push_back("--verbose");
  plan.arguments.insert(plan.arguments.end(), {"--repeat", std::to_string(options.repeat)});
  const std::vector<size_t> devices = devices_to_start_on(options.devices, options.device);
  plan.arguments.insert(plan.arguments.end(), {"--devices", fmt::format("{}", fmt::join(devices, ","))});
  plan.processes = options.processes > 0 ? options.processes : static_cast<uint32_t>(devices.size());
  if (plan.processes < devices.size())
    throw ConfigError(fmt::format(
        "--processes {}: there are {} devices, and each needs a process of its own; give at least that many",
        plan.processes, devices.size()));
  plan.command_line = invocation.command_line;
  progress.line(fmt::format(
      "{} {} on {}", plan.processes, plan.processes == 1 ? "process" : "processes",
      devices.size() == 1 ? fmt::format("device {}", devices[0]) : fmt::format("{} devices", devices.size())));
  invocation.code = start_processes(plan, progress);
}

// Returns the device of a rank: ranks of one host take devices in turn.
std::string device_of(const RunOptions& options, const Ranks& ranks) {
  if (ranks.size == 1 && !ranks.started) return options.device;
  const std::vector<size_t> devices = choose_devices(gpu::list_devices(), options.devices, options.device);
  return std::to_string(devices[ranks.local_rank % devices.size()]);
}

// Computes a part of a run that other processes compute, too.
std::optional<Results> run_shared(const DriveTask& task, const RunOptions& options, const Ranks& ranks,
                                  const ProcessInfo* me, Invocation& invocation, Progress& progress) {
  if (me) {
    Shared shared = drive_together(task, ranks, *me, progress);
    if (shared.missing > 0 || shared.unmerged)
      invocation.code = interrupted() ? ExitCode::interrupted : ExitCode::partial;
    if (shared.results.totals.frames == 0) return std::nullopt;
    return shared.results;
  }
  const ShardChoice part = parse_shard(options.shard);
  const std::string& directory = task.run.config.output.directory;
  FolderHold folder(directory, this_process(job_of(part, task.identity), part.index));
  const Shared shared = drive_part(task, part, progress);
  if (shared.missing > 0) {
    invocation.code = ExitCode::interrupted;
    progress.line(fmt::format("interrupted; {} parts of --shard {} are not computed yet; continue with --resume",
                              shared.missing, options.shard));
  } else {
    progress.line(
        fmt::format("--shard {} is done{}; when all are, `wavetracer merge {}` writes the results, "
                    "of several folders `wavetracer merge -o OUT DIR...`",
                    options.shard, shared.units == 0 ? ", and it is empty, because the run has fewer parts than N" : "",
                    directory));
  }
  return std::nullopt;
}

Sharing sharing_of(const RunOptions& options, const Ranks& ranks) {
  if (!options.shard.empty()) return Sharing::shard;
  if (ranks.size > 1 || ranks.started) return Sharing::ranks;  // a child starts no children, also if it is the only one
  return options.starts_processes() ? Sharing::starter : Sharing::alone;
}

// The words change for a first start, where compiling may take tens of seconds.
const char* loading_words() {
  return gpu::ProgramCache::from_environment().waits_for_first()
             ? "loading the scene, compiling the kernels, which takes long the first time only"
             : "loading the scene, compiling the kernels";
}

// Returns a note on the figures of an earlier run in this folder, which stay as they are; empty if there are none.
std::string old_plots(const fs::path& directory) {
  std::error_code error;
  return fs::is_directory(directory / "plots", error)
             ? "; the figures in plots stay those of that run until `wavetracer plot` draws them anew"
             : "";
}

void say_ready(const Run& run, const TraceConfig& trace, bool warn, Progress& progress) {
  double ready = 0;
  for (const auto& [stage, seconds] : run.summary.setup_seconds) ready += seconds;
  const std::string of_edges =
      run.summary.edge_rays > 0 ? fmt::format(", {} from each edge that they see", grouped(run.summary.edge_rays)) : "";
  progress.line(fmt::format("ready after {:.2f} s on {}; {} from each transmitter ({}){}", ready,
                            run.summary.device.name, launch_in_words(trace), run.config.transmitters.size(), of_edges));
  if (warn)
    for (const std::string& warning : run.summary.warnings) progress.line("warning: " + warning);
}

void say_results(const Run& run, const Results& results, bool verbose, Progress& progress) {
  std::vector<std::string> warnings = results.totals.warnings;
  add_warnings(warnings, missing_words(results.totals));
  for (const std::string& warning : warnings) progress.line("warning: " + warning);
  if (results.totals.frames == 0) return;
  std::cout << report(run, results, verbose) << std::flush;
}

void run(const RunOptions& options, Invocation& invocation) {
  const Ranks ranks = ranks_of_this_process();
  if (ranks.started) prctl(PR_SET_PDEATHSIG, SIGTERM);  // a child whose parent has ended stops after its frame
  check_options(options, ranks);
  const Sharing sharing = sharing_of(options, ranks);
  const Config config = configuration(options, sharing != Sharing::alone);
  const std::string& directory = config.output.directory;
  check_inputs(config);
  check_output_folder(directory);
  check_output_names(directory);
  if (sharing == Sharing::alone || sharing == Sharing::starter) check_not_in_use(fs::path(directory) / "shards");
  catch_interrupts(!ranks.started);
  Progress progress(sharing == Sharing::ranks ? fmt::format("rank {}: ", ranks.rank) : "");
  if (sharing == Sharing::starter) return start_children(options, config, invocation, progress);
  take_share_of_cores(ranks);
  std::optional<FolderHold> folder;
  if (sharing != Sharing::shard) folder.emplace(directory, this_process(ranks.job, ranks.rank));
  if (ranks.rank == 0 && !options.resume && folder)
    if (const std::string earlier = earlier_results(directory); !earlier.empty())
      progress.line("replaces " + earlier + old_plots(directory));
  if (ranks.rank == 0) progress.line(loading_words());
  FrameRange range;
  Simulation simulation = [&] {
    const EndOnInterrupt at_once([&folder] { folder.reset(); },
                                 ranks.started ? "" : "interrupted before the first frame; nothing was written");
    return Simulation(config, device_of(options, ranks),
                      [&](uint64_t frames) { range = parse_frames(options.frames, frames); });
  }();
  simulation.profile_every(profiled_frames);
  simulation.sum_links(!config.output.paths);
  const char* const started_as = ranks.started ? std::getenv("WAVETRACER_COMMAND") : nullptr;
  Run run = make_run(simulation, range.count(), started_as ? started_as : invocation.command_line);
  run.summary.repeat_count = options.repeat;
  say_ready(run, config.trace, ranks.rank == 0, progress);

  const bool moving = simulation.frame_count() > 1, alone = sharing == Sharing::alone;
  if (options.resume && !moving && alone)
    progress.line("--resume: this drive has only one frame, so there is nothing to resume; leave the option out");
  const DriveTask task{simulation, run, identity_of(config, run.summary, range), options.resume,
                       moving || alone ? 1 : block_count(run.config)};
  Results results;
  if (alone) {
    results = moving ? drive(task, progress) : run_still(simulation, run, progress);
  } else {
    const auto shared = run_shared(task, options, ranks, folder ? &folder->process() : nullptr, invocation, progress);
    if (!shared) return;
    results = *shared;
  }
  say_results(run, results, options.verbose, progress);
  const bool whole = results.totals.frames == run.summary.frames_asked && run.summary.repeat_count == options.repeat;
  if (interrupted() && !whole && alone) {
    invocation.code = ExitCode::interrupted;
    progress.line(unfinished(run, results, options, moving));
  }
}

}  // namespace

void add_run(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand("run", "Compute the paths of a config and write them");
  const auto options = std::make_shared<RunOptions>();
  command->add_option("-c,--config", options->file, "Config file (TOML)")->required();
  command->add_option("-o,--output", options->directory, "Folder for the results, instead of output.directory");
  command
      ->add_option("--set", options->sets, "KEY=VALUE: set a key of the config, overriding the file; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--frames", options->frames,
                      "Numbers of the first and last frame, A:B, A:, :B or A; all frames if not given");
  command->add_option("--device", options->device,
                      "OpenCL device: its index, or a part of its name or of its platform's name");
  command
      ->add_option("--repeat", options->repeat,
                   "Compute each frame N times and report the median times; what is written stays the same")
      ->check(number_range(1, 1000000));
  command->add_option("--devices", options->devices,
                      "all, gpu, cpu or indices such as 0,1,2: one process per device, and they share the run. "
                      "With mpirun or srun: the devices that the ranks of each host use in turn");
  command
      ->add_option("--processes", options->processes,
                   "Number of processes that share the run and the CPU cores; they are distributed over --devices, "
                   "or all use --device")
      ->check(number_range(1, 1024));
  command->add_option(
      "--shard", options->shard,
      "K/N: compute only part K (from 0 to N - 1) of N parts, on any machine; `wavetracer merge` joins the parts");
  command->add_flag("--resume", options->resume, "Continue a drive that was interrupted, in the same folder");
  command->add_flag("--verbose", options->verbose,
                    "Also report rays, sequences, the order of the rays, and how many rays the cache answered");
  command->callback([options, &invocation] { run(*options, invocation); });
}

}  // namespace wavetracer::app
