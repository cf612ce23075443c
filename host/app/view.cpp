// SPDX-License-Identifier: Apache-2.0
// `wavetracer view` writes a run as one HTML page.
// It needs no device.
#include "viewer/view.hpp"
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include "app/commands.hpp"
#include "app/number_range.hpp"
#include "app/standard_streams.hpp"
#include "base/digits.hpp"
#include "base/file.hpp"
#include "jobs/frame_range.hpp"

namespace wavetracer::app {

void add_view(CLI::App& program) {
  struct Options {
    std::string run, output, frames, title;
    uint64_t max_paths = 0;
  };
  CLI::App* command = program.add_subcommand("view", "Write a run as one HTML page that every browser can show");
  const auto options = std::make_shared<Options>();
  command->add_option("RUN", options->run, "Folder of a run, or its paths.h5")->required();
  command->add_option("-o,--output", options->output, "Page to write (default: view.html in the folder of the run)");
  command->add_option("--frames", options->frames,
                      "Numbers of the frames on the page: A:B, A:, :B or A; all if not given");
  command
      ->add_option(
          "--max-paths", options->max_paths,
          fmt::format(
              "Largest number of paths on the page, the strongest of all frames (default: as many as fit into {} MB)",
              page_bytes / 1'000'000))
      ->check(positive_number());
  command->add_option("--title", options->title, "Title of the page (default: the name of the folder)");
  command->callback([options] {
    const SavedRun run(options->run);
    // Frames of a part of a run (run --frames) keep their numbers.
    const FrameRange range = parse_frames(options->frames, uint64_t{run.number(run.frame_count() - 1)} + 1);
    const ViewPage page = make_view(run, {range.first, range.last, options->max_paths, options->title, page_bytes});
    const std::filesystem::path output =
        options->output.empty() ? run.file().parent_path() / "view.html" : std::filesystem::path(options->output);
    write_file(output, page.html);
    for (const std::string& warning : page.warnings) std::cerr << "warning: " << warning << "\n";
    word_about(output) << fmt::format(
        "{}: written, {:.1f} MB, {} {} in {} {}\n", output.string(), static_cast<double>(page.html.size()) / 1e6,
        grouped(page.paths), page.paths == 1 ? "path" : "paths", page.frames, page.frames == 1 ? "frame" : "frames");
  });
}

}  // namespace wavetracer::app
