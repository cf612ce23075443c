// SPDX-License-Identifier: Apache-2.0
// `wavetracer plot` makes figures of a run, each with its data and the gnuplot script that drew it.
// It needs no device; without gnuplot, data and scripts are still written.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "plots/plots.hpp"

namespace wavetracer::app {
namespace {

struct PlotOptions {
  std::string run, folder;
  std::vector<std::string> formats;
  std::optional<uint32_t> frame;
  plots::PlotChoice choice;
};

void plot(PlotOptions options) {
  options.choice.link.frame = options.frame;
  if (options.formats.empty()) options.formats = {"svg", "png"};
  options.choice.formats.clear();
  for (const std::string& format : options.formats)
    options.choice.formats.push_back(format == "svg"   ? plots::Format::svg
                                     : format == "png" ? plots::Format::png
                                                       : plots::Format::pdf);
  const SavedRun run(options.run);
  const std::filesystem::path folder =
      options.folder.empty() ? run.file().parent_path() / "plots" : std::filesystem::path(options.folder);
  const plots::PlotReport report = plots::plot_run(run, options.choice, folder);
  for (const std::string& warning : report.warnings) std::cerr << "wavetracer: warning: " << warning << "\n";
  for (const std::filesystem::path& file : report.files) std::cout << file.string() << "\n";
}

}  // namespace

void add_plot(CLI::App& program) {
  CLI::App* command = program.add_subcommand("plot", "Draw figures of a run with gnuplot");
  const auto options = std::make_shared<PlotOptions>();
  command->add_option("RUN", options->run, "Folder of a run, or its paths.h5")->required();
  command->add_option("-o,--output", options->folder,
                      "Folder for the figures; the folder plots in the folder of the run if not given");
  command
      ->add_option(
          "--what", options->choice.what,
          fmt::format("Figures to draw, separated by commas: {}; all that are possible for the run if not given",
                      fmt::join(plots::plot_names, ", ")))
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--tx", options->choice.link.tx,
                      "Name of a transmitter; the strongest links are drawn if not given");
  command->add_option("--rx", options->choice.link.rx, "Name of a receiver");
  command->add_option("--grid", options->choice.grid, "Name of a [[receiver_grid]], for --what coverage");
  command->add_option(
      "--layer", options->choice.layer,
      "Layer to draw, for --what coverage, such as sinr_db or best_server (`wavetracer help coverage`); "
      "received power if the run has a link budget, else path gain, if not given");
  command->add_option(
      "--radar", options->choice.radar,
      "Name of a [[radar]], for --what range-doppler and micro-doppler; the first one if not given. --tx and "
      "--rx name its ends; the first link if not given");
  command->add_option("--frame", options->frame,
                      "Number of the frame for figures that show one frame; if not given, "
                      "the frame of the strongest link, and the first frame for coverage and rays");
  command
      ->add_option("--format", options->formats,
                   "Formats of the figures, separated by commas: svg, png, pdf; svg and png if not given")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"svg", "png", "pdf"}));
  command->callback([options] { plot(*options); });
}

}  // namespace wavetracer::app
