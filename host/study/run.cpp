// Points, then files. The table, the script and the report appear together; the plot follows if gnuplot is there.
// Assumes a folder that can be written to: the program looks before it measures.
#include "study/run.hpp"
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <ctime>
#include <span>
#include "output/pending_file.hpp"
#include "study/plot.hpp"
#include "study/table.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer::study {
namespace {

namespace fs = std::filesystem;

std::string point_line(const Recipe& recipe, const std::vector<Row>& rows) {
  std::string text = fmt::format("{}: {} rays, tracing with the sort paid:", recipe.name, grouped(rows.front().rays));
  for (const Row& row : rows)
    text += fmt::format("{} {} {} ms", &row == &rows.front() ? "" : ",", label(row.series),
                        plain(1e3 * row.times.paid_s()));
  return text;
}

std::string report_text(const Recipe& recipe, const Request& request, const Findings& found) {
  const std::string& file = request.config.scene.file;
  std::string text =
      fmt::format("# {0}\n\n{1}\n\n![{2}]({3}.svg)\n\n", recipe.title, words_text(found.words), found.caption,
                  recipe.name) +
      fmt::format("- device: {} ({}, driver {})\n", found.device.name, found.device.platform, found.device.driver) +
      fmt::format("- scene: {}\n",
                  file.empty() ? "city " + request.config.scene.generate : fs::path(file).filename().string());
  for (const std::string& note : found.notes) text += "- " + note + "\n";
  return text + fmt::format("- date: {:%Y-%m-%d}, wavetracer {}\n- command: `{}`\n", fmt::gmtime(std::time(nullptr)),
                            WAVETRACER_VERSION, request.command_line);
}

std::vector<fs::path> write_files(const Recipe& recipe, const Request& request, const Findings& found,
                                  const Host& host) {
  PendingDirectory folder(request.config.output.directory);
  const fs::path stem = folder.path() / recipe.name;
  const auto named = [&stem](const char* ending) { return fs::path(stem.string() + ending); };
  const std::string report = report_text(recipe, request, found);
  std::vector<PendingFile> files;
  files.emplace_back(named(".csv"), std::as_bytes(std::span(found.table)));
  files.emplace_back(named(".gp"), std::as_bytes(std::span(found.script)));
  files.emplace_back(named(".md"), std::as_bytes(std::span(report)));
  commit_together(files);
  folder.keep();
  std::vector<fs::path> written;
  for (const PendingFile& file : files) written.push_back(file.path());
  const fs::path plot = named(".svg");
  std::error_code ignored;
  fs::remove(plot, ignored);  // an earlier one would belie the new table
  const std::string problem = run_gnuplot(folder.path(), recipe.name + ".gp");
  if (problem.empty()) {
    written.push_back(plot);
  } else {
    fs::remove(plot, ignored);  // half drawn
    host.say(problem);
  }
  return written;
}

RayRange series_range(const Request& request) {
  if (request.rays) return *request.rays;
  return request.quick ? RayRange{claimed_few, claimed_many} : RayRange{};
}

Findings time_series(const Recipe& recipe, const Request& request, const Host& host) {
  const std::vector<uint64_t> counts = ray_counts(series_range(request));
  Findings found;
  found.planned = counts.size();
  // Finds mistakes in the device, the scene and the ends before anything is measured.
  Config first = point_config(recipe, request.config, counts.front(), false);
  apply(first, recipe.series.front(), counts.front());
  found.device = Simulation(first, request.device).device();
  host.say(fmt::format("{}: {} series at {} to {} rays on {}", recipe.name, recipe.series.size(),
                       grouped(counts.front()), grouped(counts.back()), found.device.name));
  std::vector<Row> rows;
  for (const uint64_t rays : counts) {
    if (host.interrupted()) break;
    const std::vector<Row> point = measure(point_config(recipe, request.config, rays, found.device.gpu), recipe.series,
                                           rays, recipe.frames, request.device, request.repeats);
    host.say(point_line(recipe, point));
    rows.insert(rows.end(), point.begin(), point.end());
    ++found.points;
  }
  if (rows.empty()) return found;
  found.table = encode_table(rows);
  found.script = plot_script(recipe.name, recipe.title + ", " + found.device.name, recipe.series);
  found.words = recipe.words(rows, found.device.name);
  found.caption = "Time a ray against the number of rays";
  found.notes = {
      fmt::format("times: medians of {} warm frames, the series in turns; tracing is generate_rays, trace, compact, "
                  "scan and interact, the sort is order and sort, all from profiling events",
                  request.repeats),
      "every frame launches all rays of its transmitters: trace.reuse, trace.diffraction and cache.kind are off; where "
      "vehicles drive, it is the first frame of their drive"};
  return found;
}

}  // namespace

Findings show(const Recipe& recipe, const CacheMeasurement& measured, const Request& request) {
  if (measured.points > 0) return recipe.view(recipe, measured, request);
  Findings nothing;
  nothing.device = measured.device;
  nothing.planned = measured.planned;
  return nothing;
}

Findings find_out(const Recipe& recipe, const Request& request, const Host& host) {
  check_recipe(recipe, request.config);
  if (recipe.study) return show(recipe, measure_study(*recipe.study, request, host), request);
  if (!recipe.experiment) return time_series(recipe, request, host);
  if (request.rays)
    throw ConfigError(fmt::format("--rays {}:{}: {} launches {} rays; leave --rays out", request.rays->first,
                                  request.rays->last, recipe.name, grouped(experiment_rays)));
  return recipe.experiment(recipe, request, host);
}

Report write_report(const Recipe& recipe, const Request& request, const Findings& found, const Host& host) {
  Report report{.text = words_text(found.words), .files = {}, .points = found.points, .planned = found.planned};
  if (found.points > 0) report.files = write_files(recipe, request, found, host);
  return report;
}

Report run_recipe(const Recipe& recipe, const Request& request, const Host& host) {
  return write_report(recipe, request, find_out(recipe, request, host), host);
}

}  // namespace wavetracer::study
