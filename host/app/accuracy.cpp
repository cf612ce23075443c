// SPDX-License-Identifier: Apache-2.0
// `wavetracer accuracy` compares speed and error of the user's own scene, and advises what to set.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iostream>
#include <memory>
#include "accuracy/advice.hpp"
#include "accuracy/chances.hpp"
#include "accuracy/files.hpp"
#include "accuracy/inputs.hpp"
#include "accuracy/table.hpp"
#include "app/commands.hpp"
#include "app/idle_options.hpp"
#include "app/map_formats.hpp"
#include "app/named_files.hpp"
#include "app/number_range.hpp"
#include "app/study_host.hpp"
#include "app/written_files.hpp"
#include "coverage/chance_map.hpp"
#include "coverage/kml.hpp"
#include "coverage/write_map.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/progress.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

struct AccuracyOptions {
  accuracy::Request request;
  accuracy::ChanceRequest chances;  // its inputs are those of intervals, too
  std::vector<std::string> formats = {"csv"};
  std::string directory = "out/accuracy", rays;
  const CLI::Option* certify = nullptr;  // the flag; where it is not given, the configuration decides
  bool varies = false;
};

accuracy::InputRequest input_request(const AccuracyOptions& options) {
  accuracy::InputRequest request = options.chances.inputs;
  request.file = options.request.file;
  request.sets = options.request.sets;
  request.device = options.request.device;
  request.frames = options.request.frames;
  return request;
}

// Returns the files that were written.
std::vector<fs::path> write_chances(const accuracy::ChanceStudy& study, const std::vector<std::string>& formats,
                                    const std::optional<Georeference>& georeference, const fs::path& folder,
                                    Progress& progress) {
  for (const std::string& warning : study.warnings) progress.line("warning: " + warning);
  if (const std::string words = place_warning(formats, georeference); !words.empty())
    progress.line("warning: " + words);
  std::error_code error;
  fs::create_directories(folder, error);  // writing the files reports an error
  return coverage::write_maps({study.maps, study.drive, formats, georeference}, folder / "coverage");
}

// Makes maps of probabilities.
void run_chances(const AccuracyOptions& options, Invocation& invocation) {
  accuracy::ChanceRequest request = options.chances;
  request.inputs = input_request(options);
  check_map_formats(options.formats);
  const Config config = load_config(request.inputs.file, request.inputs.sets);
  const ReceiverGridConfig& grid = accuracy::mapped_grid(config, request);
  coverage::check_formats_of(grid.name, grid.vertical(), options.formats);
  check_inputs(config);
  const std::string& scene = config.scene.file;
  const std::optional<Georeference> georeference = scene.empty() ? std::nullopt : find_georeference(scene);
  if (has_format(options.formats, "kml")) coverage::georeference_for_kml(georeference, scene);
  const fs::path folder = begin_study(options.directory);
  Progress progress;
  const accuracy::ChanceStudy study = accuracy::study_chances(request, study_host(progress));
  if (study.stopped) {
    invocation.code = ExitCode::interrupted;
    progress.line(study.maps.empty() ? "interrupted before the first map was complete; nothing was written"
                                     : "interrupted; the written maps are those of the frames that were complete");
  }
  if (study.maps.empty()) return;
  const std::vector<fs::path> files = write_chances(study, options.formats, georeference, folder, progress);
  std::cout << accuracy::chances_text(study)
            << fmt::format("written    {}, {} files", files.front().parent_path().string(), files.size()) << std::endl;
}

void run_inputs(const AccuracyOptions& options, Invocation& invocation) {
  const accuracy::InputRequest request = input_request(options);
  check_inputs(load_config(request.file, request.sets));
  const fs::path folder = begin_study(options.directory);
  Progress progress;
  const accuracy::InputStudy study = accuracy::study_inputs(request, study_host(progress));
  if (study.stopped) {
    invocation.code = ExitCode::interrupted;
    progress.line(study.rows.empty() ? "interrupted before the first frame was complete; nothing was written"
                                     : "interrupted; the written files have the frames that were complete");
  }
  if (study.rows.empty()) return;
  const plots::Drawn drawn = plots::draw(accuracy::inputs_figure(study), plots::Format::svg, folder);
  if (!drawn.problem.empty()) progress.line(drawn.problem);
  std::cout << accuracy::inputs_text(study) << written_line(drawn.files) << std::flush;
}

void add_chance_options(CLI::App& command, AccuracyOptions& options, CLI::Option* varies, CLI::Option* discover_every) {
  CLI::Option* const threshold =
      command
          .add_option(
              "--threshold", options.chances.thresholds,
              fmt::format("With --inputs: NAME=VALUE, make maps of the probability that NAME is VALUE or more in "
                          "a cell of a [[receiver_grid]]; NAME is {}; may be repeated",
                          fmt::join(coverage::tested_names(), ", ")))
          ->allow_extra_args(false)
          ->needs(varies)
          ->excludes(discover_every);
  command
      .add_option("--grid", options.chances.grid,
                  "With --threshold: name of the [[receiver_grid]]; needed if the config has several")
      ->needs(threshold);
  command
      .add_option("--tx", options.chances.tx,
                  "With --threshold: name of the transmitter that serves all cells; the strongest of each cell if not "
                  "given")
      ->needs(threshold);
  add_map_formats(command, options.formats)->needs(threshold);
}

void add_input_options(CLI::App& command, AccuracyOptions& options) {
  accuracy::InputRequest& inputs = options.chances.inputs;
  accuracy::InputErrors& errors = inputs.errors;
  CLI::Option* const varies =
      command.add_flag("--inputs", options.varies,
                       "Vary positions, heights, materials and vehicles instead, and give each link an interval");
  const auto number = [&](const char* name, auto& value, const char* words, double least, double most) {
    return command.add_option(name, value, words)
        ->check(number_range(least, most))
        ->capture_default_str()
        ->needs(varies);
  };
  number("--samples", inputs.samples, "With --inputs: samples of a Latin hypercube", 2, 1000000);
  number("--seed", inputs.seed, "With --inputs: seed of the samples", 0, 1e18);
  CLI::Option* const discover_every =
      number("--discover-every", inputs.discover_every, "With --inputs: launch rays in every Nth sample", 1, 1000000);
  number("--position", errors.position_m, "With --inputs: standard deviation of antennas along x and y, m", 0, 1000);
  number("--height", errors.height_m, "With --inputs: standard deviation of the heights of antennas, m", 0, 1000);
  number("--permittivity", errors.permittivity, "With --inputs: relative standard deviation of materials", 0, 3);
  number("--vehicles", errors.vehicles_m, "With --inputs: standard deviation of vehicles along x and y, m", 0, 1000);
  add_chance_options(command, options, varies, discover_every);
}

// Writes the settings that were measured. stopped: these are not all, because the user wanted to stop.
void write_study(const accuracy::Study& study, bool stopped, const std::string& command_line, const fs::path& folder,
                 Progress& progress) {
  if (stopped)
    progress.line(study.rows.empty()
                      ? "interrupted before the first setting; nothing was written"
                      : fmt::format("interrupted after {} of {} settings; the written files are complete up to there",
                                    study.rows.size(), study.planned));
  if (study.rows.empty()) return;
  const accuracy::Written written = accuracy::write_files(study, command_line, folder);
  if (!written.problem.empty()) progress.line(written.problem);
  std::cout << accuracy::encode_text(study.rows) << "\n";
  for (const std::string& item : accuracy::recommendations(study)) std::cout << "- " << item << ".\n";
  std::cout << "\n" << written_line(written.files) << std::flush;
}

void run_accuracy(const AccuracyOptions& options, Invocation& invocation) {
  if (!options.chances.thresholds.empty()) return run_chances(options, invocation);
  if (options.varies) return run_inputs(options, invocation);
  accuracy::Request request = options.request;
  request.command_line = invocation.command_line;
  if (!options.rays.empty()) request.rays = study::parse_ray_range(options.rays);
  const Config config = load_config(request.file, request.sets);
  if (options.certify->count() == 0) request.certify = accuracy::beams_are_cheap(config);
  check_inputs(config);
  const fs::path folder = begin_study(options.directory);
  Progress progress;
  const study::Host host = study_host(progress);
  const accuracy::Study study = accuracy::study(request, host, [&](const accuracy::Study& so_far) {
    write_study(so_far, true, request.command_line, folder, progress);
  });
  if (interrupted()) invocation.code = ExitCode::interrupted;
  write_study(study, interrupted(), request.command_line, folder, progress);
}

}  // namespace

void add_accuracy(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "accuracy", "Measure speed and error of a config for several settings, and advise which to use");
  const auto options = std::make_shared<AccuracyOptions>();
  accuracy::Request& request = options->request;
  command->add_option("-c,--config", request.file, "Config file (TOML)")->required();
  command->add_option("-o,--output", options->directory, "Folder for the table, the plot and the page")
      ->capture_default_str();
  command->add_option("--set", request.sets, "KEY=VALUE: set a key of the config, overriding the file; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--device", request.device,
                      "OpenCL device: its index, or a part of its name or of its platform's name");
  command->add_option("--rays", options->rays, "Smallest and largest number of rays, A:B; default 1e4:1e6");
  options->certify = command->add_flag(
      "--certify,!--no-certify", request.certify,
      "Compare rays with beams, which find all paths (trace.discovery), or with ten times the largest "
      "number of rays; if not given, with beams where only reflections are asked for, six at most");
  command->add_option("--frames", request.frames, "Number of frames of a drive to measure, spread evenly over it")
      ->check(number_range(1, 1000000))
      ->capture_default_str();
  command->add_option("--repeat", request.repeats, "Compute each frame N times and use the median time")
      ->check(number_range(1, 1000000))
      ->capture_default_str();
  add_input_options(*command, *options);
  command->callback([options, command, &invocation] {
    if (options->varies)
      refuse_options(*command, {"--rays", "--certify", "--repeat"},
                     "--inputs compares samples of the inputs, all with the rays of the configuration");
    run_accuracy(*options, invocation);
  });
}

}  // namespace wavetracer::app
