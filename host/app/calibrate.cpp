// SPDX-License-Identifier: Apache-2.0
// `wavetracer calibrate` compares computed levels with measured ones, and fits materials and antennas to them.
#include <fmt/format.h>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/idle_options.hpp"
#include "app/number_range.hpp"
#include "app/study_host.hpp"
#include "app/written_files.hpp"
#include "calibration/report.hpp"
#include "jobs/progress.hpp"

namespace wavetracer::app {
namespace {

struct CalibrateOptions {
  calibration::Request request;
  std::vector<std::string> fit = {"*"};
  std::string directory = "out/calibration", offsets = "all", spreads = "none";
};

std::vector<std::string> patterns_of(const std::vector<std::string>& fit) {
  std::vector<std::string> out;
  for (std::string part : fit)
    if (!CLI::detail::trim(part).empty()) out.push_back(std::move(part));
  return out == std::vector<std::string>{"none"} ? std::vector<std::string>() : out;
}

void run_calibrate(const CalibrateOptions& options, Invocation& invocation) {
  calibration::Request request = options.request;
  request.offsets = calibration::Offsets::named(options.offsets);
  request.spreads = calibration::FittedSpreads::named(options.spreads);
  request.patterns = patterns_of(options.fit);
  const std::filesystem::path folder = begin_study(options.directory);
  Progress progress;
  const calibration::Calibration result = calibration::calibrate(request, study_host(progress));
  if (result.stopped) {
    invocation.code = ExitCode::interrupted;
    return progress.line("interrupted before the fit was complete; nothing was written");
  }
  for (const std::string& warning : result.warnings) progress.line("warning: " + warning);
  const calibration::Written written = calibration::write_calibration(result, invocation.command_line, folder);
  if (!written.problem.empty()) progress.line(written.problem);
  std::cout << calibration::calibration_text(result) << "\n" << written_line(written.files) << std::flush;
}

// The options of the fit.
void add_fit(CLI::App& command, CalibrateOptions& options) {
  calibration::Request& request = options.request;
  command
      .add_option("--fit", options.fit,
                  "Parameters to fit, separated by commas: MATERIAL or MATERIAL.PROPERTY with * and ? as in shells; "
                  "properties are permittivity, conductivity, thickness and scattering; a material alone stands for "
                  "the first two; also TRANSMITTER.height, .x, .y, .yaw, .pitch and .roll, and receivers.height, which "
                  "* alone does not choose; none: only compare")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  command
      .add_option("--offset", options.offsets,
                  "Points that share an unknown offset of levels: all, file, tx, or none of them")
      ->check(CLI::IsMember(
          std::vector<std::string>(calibration::Offsets::words.begin(), calibration::Offsets::words.end())))
      ->capture_default_str();
  command
      .add_option("--spreads", options.spreads,
                  "Measured spreads that the fit uses: all, delay, azimuth or none; the others are only compared")
      ->check(CLI::IsMember(
          std::vector<std::string>(calibration::FittedSpreads::words.begin(), calibration::FittedSpreads::words.end())))
      ->capture_default_str();
  command
      .add_option("--profiles", request.profile_bin_ns,
                  "Width of bins of delay, in ns: the fit uses the profiles of components, which are their powers in "
                  "such bins; 0: it does not")
      ->check(number_range(0.0, 1e6))
      ->capture_default_str();
  command
      .add_option("--prior", request.prior,
                  "Factor of the uncertainty that fitted values have before the measurement; smaller ones keep them "
                  "nearer to those of the configuration")
      ->check(number_range(1e-3, 1e3))
      ->capture_default_str();
  command
      .add_option("--error", request.errors,
                  "NAME=VALUE: the uncertainty of the fitted parameters of that name before the measurement, instead "
                  "of the usual one; the standard deviation in m or degrees, of a material the relative one; may be "
                  "repeated")
      ->allow_extra_args(false);
  command
      .add_option("--folds", request.folds,
                  "Blocks of neighbouring places, each of which is predicted by a fit to the others; 0: none")
      ->check(number_range(0, 100))
      ->capture_default_str();
}

}  // namespace

void add_calibrate(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "calibrate",
      "Compare computed levels with measured ones, and fit materials, places and orientations of antennas to them");
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
  add_fit(*command, *options);
  command->add_option("--level", request.level, "Name of the column with the level, where there are several");
  command->add_option("--crs", request.crs,
                      "Coordinate system of the columns x (east) and y (north), such as EPSG:25832, or a PROJ string; "
                      "the scene needs a georeference");
  command->add_option("--set", request.sets, "KEY=VALUE: set a key of the config, overriding the file; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--device", request.device,
                      "OpenCL device: its index, or a part of its name or of its platform's name");
  command->callback([options, command, &invocation] {
    if (patterns_of(options->fit).empty())
      refuse_options(*command, {"--prior", "--error", "--spreads", "--profiles"}, "--fit none fits nothing");
    run_calibrate(*options, invocation);
  });
}

}  // namespace wavetracer::app
