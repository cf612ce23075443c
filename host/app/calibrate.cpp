// SPDX-License-Identifier: Apache-2.0
// `wavetracer calibrate` compares computed levels with measured ones, and fits materials to them.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/named_files.hpp"
#include "app/study_host.hpp"
#include "calibration/report.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/progress.hpp"

namespace wavetracer::app {
namespace {

struct CalibrateOptions {
  calibration::Request request;
  std::string directory = "out/calibration", fit = "*", offsets = "all", spreads = "delay";
};

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> out;
  for (size_t first = 0; first <= text.size();) {
    const size_t end = std::min(text.find(',', first), text.size());
    std::string part = text.substr(first, end - first);
    part.erase(0, part.find_first_not_of(' '));
    part.erase(part.find_last_not_of(' ') + 1);
    if (!part.empty()) out.push_back(std::move(part));
    first = end + 1;
  }
  return out;
}

void run_calibrate(const CalibrateOptions& options, Invocation& invocation) {
  calibration::Request request = options.request;
  request.offsets = calibration::Offsets::named(options.offsets);
  request.spreads = calibration::FittedSpreads::named(options.spreads);
  request.patterns = options.fit == "none" ? std::vector<std::string>() : split_at_commas(options.fit);
  const std::filesystem::path folder = std::filesystem::absolute(options.directory).lexically_normal();
  check_output_folder(folder);
  catch_interrupts();
  Progress progress;
  const calibration::Calibration result = calibration::calibrate(request, study_host(progress));
  if (result.stopped) {
    invocation.code = ExitCode::interrupted;
    return progress.line("interrupted before the fit was complete; nothing was written");
  }
  for (const std::string& warning : result.warnings) progress.line("warning: " + warning);
  const calibration::Written written = calibration::write_calibration(result, invocation.command_line, folder);
  if (!written.problem.empty()) progress.line(written.problem);
  std::cout << calibration::calibration_text(result) << "\nwritten    ";
  for (size_t i = 0; i < written.files.size(); ++i) std::cout << (i == 0 ? "" : ", ") << written.files[i].string();
  std::cout << std::endl;
}

}  // namespace

void add_calibrate(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "calibrate", "Compare computed levels with measured ones, and fit the materials of the scene to them");
  const auto options = std::make_shared<CalibrateOptions>();
  calibration::Request& request = options->request;
  command->add_option("-c,--config", request.config, "Config file (TOML): scene, carrier, transmitters")->required();
  command
      ->add_option("--measured", request.measured,
                   "CSV file of measured values; its header names the columns x_m, y_m and z_m, or latitude, longitude "
                   "and height_m, and path_gain_db, path_loss_db or power_dbm; with delay_ns, azimuth_deg or "
                   "bearing_deg its rows are components; may be repeated")
      ->allow_extra_args(false)
      ->required();
  command->add_option("-o,--output", options->directory, "Folder for the tables, the plot, the page and fitted.toml")
      ->capture_default_str();
  command
      ->add_option("--fit", options->fit,
                   "Parameters to fit, separated by commas: MATERIAL or MATERIAL.PROPERTY with * and ? as in shells; "
                   "properties are permittivity, conductivity, thickness and scattering; a material alone stands for "
                   "the first two; none: only compare")
      ->capture_default_str();
  command
      ->add_option("--offset", options->offsets,
                   "Points that share an unknown offset of levels: all, file, tx, or none of them")
      ->check(CLI::IsMember(
          std::vector<std::string>(calibration::Offsets::words.begin(), calibration::Offsets::words.end())))
      ->capture_default_str();
  command
      ->add_option("--spreads", options->spreads,
                   "Measured spreads that the fit uses: all, delay, azimuth or none; the others are only compared")
      ->check(CLI::IsMember(
          std::vector<std::string>(calibration::FittedSpreads::words.begin(), calibration::FittedSpreads::words.end())))
      ->capture_default_str();
  command
      ->add_option("--prior", request.prior,
                   "Factor of the uncertainty that materials have before the measurement; smaller values keep them "
                   "nearer to those of the configuration")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  command
      ->add_option("--folds", request.folds,
                   "Blocks of neighbouring places, each of which is predicted by a fit to the others; 0: none")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  command->add_option("--level", request.level, "Name of the column with the level, where there are several");
  command->add_option("--crs", request.crs,
                      "Coordinate system of the columns x (east) and y (north), such as EPSG:25832, or a PROJ string; "
                      "the scene needs a georeference");
  command->add_option("--set", request.sets, "KEY=VALUE: set a key of the config, overriding the file; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--device", request.device,
                      "OpenCL device: its index, or a part of its name or of its platform's name");
  command->callback([options, &invocation] { run_calibrate(*options, invocation); });
}

}  // namespace wavetracer::app
