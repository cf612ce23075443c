// `wavetracer accuracy`: speed against error of the user's own scene, and what to set.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include "accuracy/advice.hpp"
#include "accuracy/files.hpp"
#include "accuracy/table.hpp"
#include "app/commands.hpp"
#include "app/named_files.hpp"
#include "app/study_host.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/progress.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

struct AccuracyOptions {
  accuracy::Request request;
  std::string directory = "out/accuracy", rays;
};

void run_accuracy(const AccuracyOptions& options, Invocation& invocation) {
  accuracy::Request request = options.request;
  request.command_line = invocation.command_line;
  if (!options.rays.empty()) request.rays = study::parse_ray_range(options.rays);
  check_inputs(load_config(request.file, request.sets));
  const fs::path folder = fs::absolute(options.directory).lexically_normal();
  check_output_folder(folder);
  catch_interrupts();
  Progress progress;
  const study::Host host = study_host(progress);
  const accuracy::Study study = accuracy::study(request, host);
  if (interrupted()) {
    invocation.code = ExitCode::interrupted;
    progress.line(study.rows.empty()
                      ? "interrupted before the first setting; nothing was written"
                      : fmt::format("interrupted after {} of {} settings; the written files are complete up to there",
                                    study.rows.size(), study.planned));
  }
  if (study.rows.empty()) return;
  const accuracy::Written written = accuracy::write_files(study, request.command_line, folder);
  if (!written.problem.empty()) progress.line(written.problem);
  std::cout << accuracy::encode_text(study.rows) << "\n";
  for (const std::string& item : accuracy::recommendations(study)) std::cout << "- " << item << ".\n";
  std::cout << "\nwritten    ";
  for (size_t i = 0; i < written.files.size(); ++i) std::cout << (i == 0 ? "" : ", ") << written.files[i].string();
  std::cout << std::endl;
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
  command->add_option(
      "--rays", options->rays,
      "Smallest and largest number of rays, A:B; default 1e4:1e6. The reference launches ten times the largest number");
  command->add_option("--frames", request.frames, "Number of frames of a drive to measure, spread evenly over it")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--repeat", request.repeats, "Compute each frame N times and use the median time")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->callback([options, &invocation] { run_accuracy(*options, invocation); });
}

}  // namespace wavetracer::app
