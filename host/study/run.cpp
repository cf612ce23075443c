// SPDX-License-Identifier: Apache-2.0
// Measures points, then writes files. The table, the script and the report appear together; the plot follows if gnuplot
// is there. The folder must be writable: the program checks that before it measures.
#include "study/run.hpp"
#include <fmt/format.h>
#include <span>
#include "base/output_place.hpp"
#include "base/pending_file.hpp"
#include "study/page.hpp"
#include "study/scripts.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> write_files(const Experiment& experiment, const Request& request, const Findings& found,
                                  const Host& host) {
  PendingDirectory folder(request.config.output.directory);
  const fs::path stem = folder.path() / experiment.name;
  const auto named = [&stem](const char* ending) { return fs::path(stem.string() + ending); };
  const std::string report =
      page_markdown(section_of(experiment, found), heading_of(request.config, found.device, request.command_line));
  std::vector<PendingFile> files;
  files.emplace_back(named(".csv"), std::as_bytes(std::span(found.table)));
  files.emplace_back(named(".gp"), std::as_bytes(std::span(found.script)));
  files.emplace_back(named(".md"), std::as_bytes(std::span(report)));
  commit_together(files);
  folder.keep();
  std::vector<fs::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  const fs::path plot = named(".svg");
  remove_old_file(plot);  // an old plot would not match the new table
  const std::string problem = run_gnuplot(folder.path(), experiment.name + ".gp");
  if (problem.empty()) {
    written.push_back(plot);
  } else {
    remove_old_file(plot);  // it is incomplete
    host.say(problem);
  }
  return written;
}

}  // namespace

Findings find_out(const Experiment& experiment, const Request& request, const Host& host) {
  check_experiment(experiment, request.config);
  if (request.rays && experiment.one_ray_count())
    throw ConfigError(fmt::format("--rays {}:{}: {} launches {} rays; leave --rays out", request.rays->first,
                                  request.rays->last, experiment.name,
                                  grouped(experiment.study() ? experiment.study()->rays.front() : experiment_rays)));
  return std::visit([&](const auto& figure) { return measure(figure, experiment, request, host); }, experiment.figure);
}

Report write_report(const Experiment& experiment, const Request& request, const Findings& found, const Host& host) {
  Report report{.text = words_text(found.words), .files = {}, .points = found.points, .planned = found.planned};
  if (found.points > 0) report.files = write_files(experiment, request, found, host);
  return report;
}

Report run_experiment(const Experiment& experiment, const Request& request, const Host& host) {
  return write_report(experiment, request, find_out(experiment, request, host), host);
}

}  // namespace wavetracer::study
