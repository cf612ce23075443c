// SPDX-License-Identifier: Apache-2.0
// `wavetracer thesis EXPERIMENT` runs an experiment of the thesis by name and writes tables, a plot and a report.
// The programs of bench/ measure the speed of single parts.
#include "study/thesis.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include "app/commands.hpp"
#include "app/idle_options.hpp"
#include "app/named_files.hpp"
#include "app/number_range.hpp"
#include "app/study_host.hpp"
#include "app/written_files.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/progress.hpp"
#include "study/run.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

struct ThesisOptions {
  std::string file, directory, device, rays;
  std::vector<std::string> experiments, sets;
  uint32_t repeats = 5;
  uint64_t frames = 0;
  bool quick = false;
  std::optional<double> minutes;
};

constexpr const char* all_figures = "all";

study::Request request(const ThesisOptions& options, const study::Experiment& experiment,
                       const std::string& command_line) {
  study::Request out{.config = study::experiment_config(experiment, options.file, options.sets),
                     .device = options.device,
                     .rays = {},
                     .repeats = options.repeats,
                     .frames = options.frames,
                     .quick = options.quick,
                     .minutes = options.minutes,
                     .command_line = command_line};
  if (!options.rays.empty()) out.rays = study::parse_ray_range(options.rays);
  if (out.rays && !experiment.study()) study::ray_counts(*out.rays);  // throws if there are none
  if (!options.directory.empty())
    out.config.output.directory = fs::absolute(options.directory).lexically_normal().string();
  return out;
}

std::string listed() {
  return study::experiment_list() + fmt::format("  {:<18} {}\n", all_figures, "all figures, as one page: thesis.html");
}

// Throws ConfigError for a name that no experiment has, or that is given twice.
std::vector<const study::Experiment*> wanted(const std::vector<std::string>& names) {
  if (names.size() == 1 && names.front() == all_figures) return study::thesis_experiments();
  std::vector<const study::Experiment*> out;
  for (const std::string& name : names) {
    if (name == all_figures) throw ConfigError("thesis: \"all\" has every figure; give no other name beside it");
    out.push_back(&study::find_experiment(name));
    if (std::ranges::count(names, name) > 1) throw ConfigError(fmt::format("thesis: \"{}\" is given twice", name));
  }
  return out;
}

// Throws ConfigError for an option that does not change the experiment. Several experiments share their options, each
// of which need not be about all of them.
void check_kinds(const CLI::App& command, const std::vector<const study::Experiment*>& experiments) {
  if (experiments.empty())
    refuse_options(command, {"-c", "-o", "--set", "--device", "--rays", "--repeat", "--frames", "--minutes", "--quick"},
                   "no experiment is named; `wavetracer thesis` lists them");
  if (experiments.size() != 1) return;
  const study::Experiment& one = *experiments.front();
  const bool orders = one.as<study::OrderFigure>() != nullptr, caches = one.study() != nullptr;
  if (!orders) refuse_options(command, {"--minutes"}, "it is for figures of orders, such as figure-6.1");
  if (!one.moves() && !caches)
    refuse_options(command, {"--frames"}, "it is for experiments with the frames of a drive, such as figure-6.13");
  if (!(orders && !one.moves()) && !caches)
    refuse_options(command, {"--repeat"}, "this experiment compares hits, or averages over frames (--frames)");
  if (one.as<study::LagFigure>()) refuse_options(command, {"--quick"}, "this experiment has one launch alone");
}

void study_thesis(const ThesisOptions& options, Invocation& invocation) {
  if (options.experiments.empty()) {
    std::cout << "Experiments, run by `wavetracer thesis NAME -o FOLDER`:\n" << listed();
    return;
  }
  const std::vector<const study::Experiment*> experiments = wanted(options.experiments);
  const bool all = experiments.size() > 1;  // with a page of all of them
  const study::Experiment& experiment = *experiments.front();
  const study::Request asked = request(options, experiment, invocation.command_line);
  check_inputs(asked.config);
  begin_study(asked.config.output.directory);
  Progress progress;
  const study::Host host = study_host(progress);
  const study::Report report =
      all ? run_thesis(
                experiments, [&](const auto& one) { return request(options, one, invocation.command_line); }, host)
          : run_experiment(experiment, asked, host);
  if (interrupted()) {
    invocation.code = ExitCode::interrupted;
    progress.line(report.files.empty()
                      ? "interrupted before the first point; nothing was written"
                      : fmt::format("interrupted after {} of {} {}; the written files are complete up to there",
                                    report.points, report.planned, all ? "figures" : "numbers of rays"));
  }
  if (all && report.points < report.planned && !interrupted()) invocation.code = ExitCode::partial;
  if (report.files.empty()) return;
  std::cout << report.text << "\n\n" << written_line(report.files) << std::flush;
}

}  // namespace

void add_thesis(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("thesis", "Run experiments of the thesis by their names; without a name, list them");
  const auto options = std::make_shared<ThesisOptions>();
  command->add_option("experiment", options->experiments,
                      "Name of the experiment; several are measured together where they share a measurement, and have "
                      "one page");
  command->add_option("-c,--config", options->file,
                      "Config file whose scene, transmitters and receivers are used instead of a generated city; "
                      "the experiment sets rays, directions, order and launch shape itself");
  command->add_option("-o,--output", options->directory, "Folder for the results, instead of output.directory");
  command
      ->add_option("--set", options->sets, "KEY=VALUE: set a key of the config, overriding the file; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--device", options->device,
                      "OpenCL device: its index, or a part of its name or of its platform's name");
  command->add_option(
      "--rays", options->rays,
      "Smallest and largest number of rays, A:B; default: those of the figure, on CPUs fewer for experiments "
      "with caches");
  command->add_option("--repeat", options->repeats, "Number of measurements of each point; the median counts")
      ->check(number_range(1, 1000000))
      ->capture_default_str();
  command
      ->add_option(
          "--frames", options->frames,
          "Number of frames that follow the first one of a drive and are averaged over; default 500, on CPUs 20; "
          "of figure-6.13 99, of coherence-frames 200")
      ->check(number_range(1, 1000000));
  command
      ->add_option("--minutes", options->minutes,
                   "Figures of orders (6.1, 6.18) begin no number of rays that would end later than this; "
                   "default 3 on a GPU and 10 on a CPU, without a limit where --rays is given")
      ->check(number_range(0.001, 1e6));
  command->add_flag("--quick", options->quick, "Use fewer rays and a fifth of the frames");
  command->footer("");  // removes the program's footer, which would be printed too
  command->footer([] { return "Experiments:\n" + listed(); });
  command->callback([options, command, &invocation] {
    check_kinds(*command, wanted(options->experiments));
    study_thesis(*options, invocation);
  });
}

}  // namespace wavetracer::app
