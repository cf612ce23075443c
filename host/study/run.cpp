// SPDX-License-Identifier: Apache-2.0
// Measures points, then writes files. The table, the script and the report appear together; the plot follows if gnuplot
// is there. The folder must be writable: the program checks that before it measures.
#include "study/run.hpp"
#include <fmt/format.h>
#include "study/page.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> write_files(const Experiment& experiment, const Request& request, const Findings& found,
                                  const Host& host) {
  plots::Figure figure = found.figure;
  figure.data.push_back(
      {experiment.name + ".md",
       page_markdown(section_of(experiment, found), heading_of(request.config, found.device, request.command_line))});
  const plots::Drawn drawn = draw(figure, plots::Format::svg, request.config.output.directory);
  if (!drawn.problem.empty()) host.say(drawn.problem);
  return drawn.files;
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
