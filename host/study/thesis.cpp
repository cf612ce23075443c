// Figure by figure: measure or take the study's rows, write the files, keep what the page shows.
// Requests are made before anything is measured: what is wrong with one is a mistake of the user's, and not forgiven.
#include "study/thesis.hpp"
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <algorithm>
#include <ctime>
#include <fstream>
#include <map>
#include <span>
#include <sstream>
#include "output/pending_file.hpp"
#include "study/plot.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::study {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

ThesisFigure unmeasured(const Recipe& recipe) {
  return {.name = recipe.name,
          .title = recipe.title,
          .problem = "not measured: the program ended or was interrupted before"};
}

using Studies = std::map<std::string, CacheMeasurement>;

// A recipe that launches one number of rays takes no range of them; series end early on CPUs.
Request fitting(Request request, const Recipe& recipe, bool gpu) {
  if (recipe.experiment || (recipe.study && recipe.study->rays.size() == 1)) request.rays.reset();
  const bool series = !recipe.experiment && !recipe.study;
  if (series && !gpu) request.quick = true;
  return request;
}

Findings findings(const Recipe& recipe, const Request& request, const Host& host, Studies& studies) {
  check_recipe(recipe, request.config);
  if (!recipe.study) return find_out(recipe, request, host);
  const auto known = studies.find(recipe.study->name);
  if (known != studies.end()) return show(recipe, known->second, request);
  return show(recipe, studies[recipe.study->name] = measure_study(*recipe.study, request, host), request);
}

// What the page shows of a figure; errors become sentences.
ThesisFigure figure_of(const Recipe& recipe, const Request& request, const Host& host, Studies& studies,
                       Report& report) {
  ThesisFigure figure = unmeasured(recipe);
  if (host.interrupted()) return figure;
  figure.problem.clear();
  try {
    const Findings found = findings(recipe, request, host, studies);
    write_report(recipe, request, found, host);
    report.points += found.points > 0 && found.points == found.planned;
    figure.words = found.words;
    figure.notes = found.notes;
    if (found.points < found.planned)
      figure.problem = fmt::format("interrupted after {} of {} points", found.points, found.planned);
    const fs::path plot = fs::path(request.config.output.directory) / (recipe.name + ".svg");
    if (found.points > 0 && fs::exists(plot))
      figure.svg = inline_svg(contents(plot), recipe.name + "-");
    else if (found.points > 0)
      figure.problem += fmt::format("{}no plot, as gnuplot is absent or failed; the numbers are in {}.csv",
                                    figure.problem.empty() ? "" : "; ", recipe.name);
  } catch (const std::exception& error) {
    figure.problem = fmt::format("failed: {}", error.what());
    host.say(recipe.name + " failed: " + error.what());
  }
  return figure;
}

void write(const fs::path& path, const std::string& text) {
  PendingFile(path, std::as_bytes(std::span(text))).commit();
}

// The page as far as it goes, so that whatever ends the program later leaves it.
void write_so_far(const ThesisPage& page, const fs::path& directory) {
  PendingDirectory folder(directory);
  write(folder.path() / "thesis.html", thesis_html(page));
  folder.keep();
}

// thesis.csv, its plot and the page.
void write_page(ThesisPage& page, const fs::path& directory, const Host& host, Report& report) {
  PendingDirectory folder(directory);
  const auto named = [&folder](const char* name) { return folder.path() / name; };
  std::error_code ignored;
  fs::remove(named("thesis.svg"), ignored);  // an earlier one would belie the new table
  if (!page.rows.empty()) {
    write(named("thesis.csv"), speed_error_table(page.rows));
    write(named("thesis.gp"), speed_error_script(page.rows, page.device.name));
    const std::string problem = run_gnuplot(folder.path(), "thesis.gp");
    if (problem.empty())
      page.svg = inline_svg(contents(named("thesis.svg")), "thesis-");
    else
      host.say(problem);
  }
  write(named("thesis.html"), thesis_html(page));
  folder.keep();
  report.files.push_back(named("thesis.html"));
}

}  // namespace

std::vector<const Recipe*> thesis_recipes() {
  std::vector<const Recipe*> out;
  for (const Recipe& recipe : recipes())
    if (recipe.name.starts_with("figure-") || recipe.study) out.push_back(&recipe);
  const auto number = [](const Recipe* recipe) {
    return recipe->name.starts_with("figure-6.") ? std::stoul(recipe->name.substr(9)) : 1000;
  };
  std::stable_sort(out.begin(), out.end(),
                   [&number](const Recipe* a, const Recipe* b) { return number(a) < number(b); });
  return out;
}

Report run_thesis(const std::function<Request(const Recipe&)>& request_for, const Host& host) {
  const std::vector<const Recipe*> figures = thesis_recipes();
  std::vector<Request> requests;  // all of them before hours of measuring, since each may hold a mistake of the user's
  for (const Recipe* recipe : figures) requests.push_back(request_for(*recipe));
  const Request& first = requests.front();
  Config probe = first.config;
  probe.trace.rays = 1000;
  ThesisPage page;
  page.device = Simulation(probe, first.device).device();
  page.scene = first.config.scene.file.empty() ? "city " + first.config.scene.generate
                                               : fs::path(first.config.scene.file).filename().string();
  page.command_line = first.command_line;
  page.date = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
  Studies studies;
  Report report{.text = "", .files = {}, .points = 0, .planned = figures.size()};
  for (const Recipe* recipe : figures) page.figures.push_back(unmeasured(*recipe));
  for (size_t i = 0; i < figures.size(); ++i) {
    const Request request = fitting(requests[i], *figures[i], page.device.gpu);
    page.figures[i] = figure_of(*figures[i], request, host, studies, report);
    page.rows.clear();
    for (const auto& [name, measured] : studies)
      page.rows.insert(page.rows.end(), measured.rows.begin(), measured.rows.end());
    write_so_far(page, first.config.output.directory);
  }
  write_page(page, first.config.output.directory, host, report);
  report.text =
      fmt::format("{} of {} figures are whole: {}", report.points, report.planned, report.files.back().string());
  return report;
}

}  // namespace wavetracer::study
