// SPDX-License-Identifier: Apache-2.0
// The page and the plot are made of the tables.
#include "calibration/report.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>
#include "base/aligned_text.hpp"
#include "base/digits.hpp"
#include "base/html_page.hpp"
#include "base/pending_file.hpp"
#include "base/xml_text.hpp"
#include "calibration/spread_agreement.hpp"
#include "plots/gnuplot.hpp"
#include "study/page.hpp"
#include "wavetracer/config_file.hpp"

namespace wavetracer::calibration {
namespace {

namespace fs = std::filesystem;

std::string table_text(const study::NumberTable& table) {
  std::vector<std::vector<std::string>> rows{table.heads};
  rows.insert(rows.end(), table.rows.begin(), table.rows.end());
  return aligned_text(rows);
}

std::string how(const Calibration& result) {
  const std::string head = fmt::format("{} points, {} paths found in {:.2f} s", grouped(result.points.size()),
                                       grouped(result.paths), result.solve_s);
  if (result.frames_solved > 0)
    return fmt::format("{}; {} evaluations in {:.2f} s, for which {} frames were solved with ends in other places",
                       head, result.evaluations, result.fit_s, result.frames_solved);
  return fmt::format(
      "{}, {} of which make all but 1e-4 of the power of each link; {} evaluations of their fields in {:.2f} s", head,
      grouped(result.paths_that_matter), result.evaluations, result.fit_s);
}

std::string fitted_toml(const Calibration& result) {
  return fmt::format(
      "# {} with values that were fitted to measured ones at {:g} GHz. Fitted materials are constants at this "
      "carrier,\n# and no laws over frequency.\n{}",
      fs::path(result.config.file).filename().string(), 1e-9 * result.config.radio.frequency_hz,
      resolved_config(result.config));
}

std::string page_html(const Calibration& result, const std::string& command_line, const std::string& svg) {
  study::Heading heading = study::heading_of(result.config, result.device, command_line);
  std::string text = fmt::format("<h1>Calibration: {}</h1>\n{}", xml_text(result.config.file),
                                 study::heading_html(heading, {how(result)}));
  text += svg + study::table_html(agreement_table(result)) + study::table_html(parameter_table(result));
  for (const study::NumberTable& table : {spread_table(result), profile_table(result)})
    if (!table.rows.empty()) text += study::table_html(table);
  const std::vector<std::string> found = findings(result);
  if (!found.empty()) text += "<h2>Notes</h2>\n<ul>\n";
  for (const std::string& item : found) text += fmt::format("<li>{}.</li>\n", xml_text(item));
  if (!found.empty()) text += "</ul>\n";
  return html_page("Calibration", "body{max-width:1320px}", text);
}

}  // namespace

std::string calibration_text(const Calibration& result) {
  std::string text =
      how(result) + "\n\n" + table_text(agreement_table(result)) + "\n" + table_text(parameter_table(result));
  for (const study::NumberTable& table : {spread_table(result), profile_table(result)})
    if (!table.rows.empty()) text += "\n" + table_text(table);
  for (const std::string& item : findings(result)) text += "note: " + item + "\n";
  return text;
}

plots::Figure calibration_figure(const Calibration& result) {
  std::vector<double> left;
  for (const FittedPoint& point : result.points)
    if (const double off = point.measured_db - point.after.gain_db - point.offset_db; std::isfinite(off))
      left.push_back(std::abs(off));
  std::ranges::sort(left);
  const double most = left.empty() ? 1 : std::max(1.0, left[left.size() * 9 / 10]);
  plots::Figure figure{.name = "calibration",
                       .title = "",
                       .data = {{"calibration.csv", points_csv(result)}},
                       .commands = "",
                       .width_px = 1300,
                       .height_px = 560};
  figure.commands = fmt::format(
      "set datafile missing nan\n"
      "set multiplot layout 1,2 margins screen 0.07,0.92,0.13,0.92 spacing screen 0.1\n"
      "set xlabel 'computed gain, dB'\nset ylabel 'measured gain, dB'\nset key left top\n"
      "plot 'calibration.csv' skip 1 using 11:9 with points pointtype 6 linecolor '{0}' title 'as configured', \\\n"
      "  '' skip 1 using 12:9 with points pointtype 7 pointsize 0.6 linecolor '{1}' title 'fitted', \\\n"
      "  x with lines linecolor '{2}' title 'equal'\n"
      "set xlabel 'x, m'\nset ylabel 'y, m'\nset key off\nset cblabel 'measured minus fitted, dB'\n"
      "set cbrange [-{3:.3g}:{3:.3g}]\nset palette defined (-1 '{4}', 0 '#dddddd', 1 '{5}')\n"
      "plot 'calibration.csv' skip 1 using 5:6:($9 - $12) with points pointtype 7 pointsize 0.7 palette\n"
      "unset multiplot\n",
      plots::colours[1], plots::colours[5], plots::colours[4], most, plots::colours[5], plots::colours[6]);
  return figure;
}

Written write_calibration(const Calibration& result, const std::string& command_line, const fs::path& folder) {
  plots::Drawn drawn = plots::draw(calibration_figure(result), plots::Format::svg, folder);
  const std::string svg =
      drawn.problem.empty() ? study::inline_svg(study::file_text(drawn.files.back()), "calibration-") : "";
  const std::string page = page_html(result, command_line, svg), parameters = parameters_csv(result),
                    config = fitted_toml(result);
  std::vector<PendingFile> files;
  files.emplace_back(folder / "parameters.csv", std::as_bytes(std::span(parameters)));
  files.emplace_back(folder / "fitted.toml", std::as_bytes(std::span(config)));
  files.emplace_back(folder / "calibration.html", std::as_bytes(std::span(page)));
  commit_together(files);
  for (const PendingFile& file : files) drawn.files.push_back(file.path());
  return {drawn.files, drawn.problem};
}

}  // namespace wavetracer::calibration
