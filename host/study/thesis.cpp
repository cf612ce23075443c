// SPDX-License-Identifier: Apache-2.0
// Goes figure by figure: measures or takes the study's rows, writes the files, keeps the section for the page.
// Requests are made before anything is measured: a mistake of the user in one of them ends the program.
#include "study/thesis.hpp"
#include <fmt/format.h>
#include <map>
#include <span>
#include "base/output_place.hpp"
#include "base/pending_file.hpp"
#include "base/stopwatch.hpp"
#include "study/scripts.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

namespace fs = std::filesystem;

Section unmeasured(const Experiment& experiment) {
  return {.name = experiment.name,
          .title = experiment.title,
          .problem = "not measured: the program ended or was interrupted before"};
}

using Studies = std::map<std::string, CacheMeasurement>;

// An experiment that launches one number of rays takes no range of them; figures of orders end early on CPUs.
Request fitting(Request request, const Experiment& experiment, bool gpu) {
  if (experiment.one_ray_count()) request.rays.reset();
  if (experiment.as<OrderFigure>() && !gpu) request.quick = true;
  return request;
}

Findings findings(const Experiment& experiment, const Request& request, const Host& host, Studies& studies) {
  if (!experiment.study()) return find_out(experiment, request, host);
  check_experiment(experiment, request.config);
  const CacheStudy& study = *experiment.study();
  if (!studies.contains(study.name)) studies[study.name] = measure_study(study, request, host);
  return show(experiment, studies.at(study.name), request);
}

// Returns the page's section of a figure; errors become sentences.
Section figure_of(const Experiment& experiment, const Request& request, const Host& host, Studies& studies,
                  Report& report) {
  Section figure = unmeasured(experiment);
  if (host.interrupted()) return figure;
  figure.problem.clear();
  Stopwatch watch;
  try {
    Findings found = findings(experiment, request, host, studies);
    found.notes.push_back(
        fmt::format("it took {:.1f} s, without measurements that figures before it share", watch.lap()));
    write_report(experiment, request, found, host);
    report.points += found.points > 0 && found.points == found.planned;
    figure = section_of(experiment, found);
    if (found.points < found.planned)
      figure.problem = fmt::format("interrupted after {} of {} points", found.points, found.planned);
    const fs::path plot = fs::path(request.config.output.directory) / (experiment.name + ".svg");
    if (found.points > 0 && fs::exists(plot))
      figure.svg = inline_svg(file_text(plot), experiment.name + "-");
    else if (found.points > 0)
      figure.problem += fmt::format("{}no plot, as gnuplot is absent or failed; the numbers are in {}.csv",
                                    figure.problem.empty() ? "" : "; ", experiment.name);
  } catch (const std::exception& error) {
    figure.problem = fmt::format("failed: {}", error.what());
    host.say(experiment.name + " failed: " + error.what());
  }
  return figure;
}

void write(const fs::path& path, const std::string& text) {
  PendingFile(path, std::as_bytes(std::span(text))).commit();
}

// Writes the page so far, so that it exists even if the program is ended later.
void write_so_far(const ThesisPage& page, const fs::path& directory) {
  PendingDirectory folder(directory);
  write(folder.path() / "thesis.html", thesis_html(page));
  folder.keep();
}

// Writes thesis.csv, its plot and the page.
void write_page(ThesisPage& page, const fs::path& directory, const Host& host, Report& report) {
  PendingDirectory folder(directory);
  const auto named = [&folder](const char* name) { return folder.path() / name; };
  remove_old_file(named("thesis.svg"));  // an old plot would not match the new table
  if (!page.rows.empty()) {
    const plots::Drawn drawn =
        draw(speed_error_figure(page.rows, page.heading.device.name), plots::Format::svg, folder.path());
    if (drawn.problem.empty())
      page.svg = inline_svg(file_text(named("thesis.svg")), "thesis-");
    else
      host.say(drawn.problem);
  }
  write(named("thesis.html"), thesis_html(page));
  write(named("thesis.md"), thesis_markdown(page));
  folder.keep();
  for (const char* name : {"thesis.html", "thesis.md"}) report.files.push_back(named(name));
}

}  // namespace

std::vector<const Experiment*> thesis_experiments() {
  std::vector<const Experiment*> out;
  for (const Experiment& experiment : experiments())
    if (experiment.name.starts_with("figure-") || experiment.study()) out.push_back(&experiment);
  return out;
}

Report run_thesis(const std::vector<const Experiment*>& figures,
                  const std::function<Request(const Experiment&)>& request_for, const Host& host) {
  std::vector<Request> requests;  // all of them before hours of measuring, since each may contain a mistake of the user
  for (const Experiment* experiment : figures) requests.push_back(request_for(*experiment));
  const Request& first = requests.front();
  Config probe = first.config;
  probe.trace.rays = 1000;
  ThesisPage page;
  page.heading = heading_of(first.config, Simulation(probe, first.device).device(), first.command_line);
  Studies studies;
  Report report{.text = "", .files = {}, .points = 0, .planned = figures.size()};
  for (const Experiment* experiment : figures) page.figures.push_back(unmeasured(*experiment));
  for (size_t i = 0; i < figures.size(); ++i) {
    host.tell(figures[i]->name, i, figures.size(), "figures");
    const Request request = fitting(requests[i], *figures[i], page.heading.device.gpu);
    page.figures[i] = figure_of(*figures[i], request, host, studies, report);
    page.rows.clear();
    for (const auto& [name, measured] : studies)
      page.rows.insert(page.rows.end(), measured.rows.begin(), measured.rows.end());
    write_so_far(page, first.config.output.directory);
  }
  write_page(page, first.config.output.directory, host, report);
  report.text = markdown(verdicts_of(page.figures)) + fmt::format("\n\n{}\n\n{} of {} figures are whole",
                                                                  markdown(outcome_counts(page.figures)), report.points,
                                                                  report.planned);
  return report;
}

}  // namespace wavetracer::study
