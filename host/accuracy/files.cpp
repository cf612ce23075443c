// SPDX-License-Identifier: Apache-2.0
// Writes the table first, because the plot and the page are made from it. The plot, which needs gnuplot 5.2, has two
// panels on logarithmic axes with one colour per axis; rows that lose nothing lie at the bottom, where the scale says
// "none".
#include "accuracy/files.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>
#include "accuracy/advice.hpp"
#include "accuracy/label_places.hpp"
#include "accuracy/table.hpp"
#include "base/digits.hpp"
#include "base/html_page.hpp"
#include "base/pending_file.hpp"
#include "base/xml_text.hpp"
#include "plots/gnuplot.hpp"
#include "study/page.hpp"
#include "study/scripts.hpp"

namespace wavetracer::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr const char* style =
    "body{max-width:1320px}.own{background:#eef6fb}.reference{font-weight:bold}td:nth-child(4){white-space:nowrap}"
    "@media(max-width:1100px){table{font-size:11px}td,th{padding:2px 4px}}"
    "@media(prefers-color-scheme:dark){.own{background:#22364a}}";

std::string table_html(const std::vector<Row>& rows) {
  std::string text = "<table>\n<thead><tr>" + html_cells(short_columns(), "th") + "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows)
    text += fmt::format("<tr class=\"{}{}\">{}</tr>\n", row.own ? "own " : "", row.reference ? "reference" : "",
                        html_cells(short_cells(row), "td"));
  return text + "</tbody>\n</table>\n";
}

std::string frames_text(const Study& study) {
  const std::string times = study.repeats == 1
                                ? "the time of a frame is that of a warm frame, solved once"
                                : fmt::format(
                                      "the time of a frame is the median of warm frames, each solved {} times, "
                                      "once where it takes more than two seconds",
                                      study.repeats);
  if (!study.drive) return fmt::format("one frame with {} links; {}", grouped(study.links), times);
  return fmt::format("{} of the drive, {} links in all, each frame cold but for the rows of reuse; {}",
                     study.frames == 1 ? "one frame" : fmt::format("{} frames spread over the time", study.frames),
                     grouped(study.links), times);
}

constexpr double none = 1e-8;  // share at which 0 and smaller values are drawn

size_t column(const std::string& name) { return study::column_of(csv_columns(), name); }

// Mechanisms that are on or off share one series, so that there are fewer than the eight colours.
constexpr const char* mechanism_series = "mechanisms";

bool is_mechanism(const Row& row) {
  return row.setting.axis != "reuse" && (row.setting.name == "on" || row.setting.name == "off");
}

std::string series_of(const Row& row) { return is_mechanism(row) ? mechanism_series : row.setting.axis; }

std::string label_of(const Row& row) {
  std::string axis = row.setting.axis;
  std::ranges::replace(axis, '_', ' ');
  return is_mechanism(row) ? axis + " " + row.setting.name : row.setting.name;
}

// Returns the series with a measured row, in their order.
std::vector<std::string> measured_series(const Study& study) {
  std::vector<std::string> out;
  for (const Row& row : study.rows)
    if (row.measured() && std::ranges::find(out, series_of(row)) == out.end()) out.push_back(series_of(row));
  return out;
}

// The figure in pixels, its panels as shares of it, and its axes: milliseconds, shares.
constexpr double width_px = 1300, height_px = 560;
constexpr double left = 0.07, right = 0.83, bottom = 0.13, top = 0.86, between = 0.08;
constexpr double panel_width_px = (right - left - between) / 2 * width_px, panel_height_px = (top - bottom) * height_px;
struct Axes {
  double x_low, x_high, y_low = 0.5 * none, y_high = 2;
};

Axes axes_of(const Study& study) {
  double least = 1e300, most = 0;
  for (const Row& row : study.rows)
    if (row.measured()) {
      least = std::min(least, 1e3 * row.frame_s);
      most = std::max(most, 1e3 * row.frame_s);
    }
  return {.x_low = 0.7 * least, .x_high = 2 * most};
}

// One value of rows is drawn in a panel.
struct Panel {
  const char* column;  // name of a column of the table
  const char* title;
  double study::PathError::*value;
};

// Returns commands that write the labels of a panel, as many as have a free place. Those of the user's own settings
// choose first, then references.
std::string labels(const Study& study, const Panel& panel, const Axes& axes, const std::vector<std::string>& series) {
  std::vector<const Row*> rows;
  for (const Row& row : study.rows)
    if (row.measured()) rows.push_back(&row);
  std::ranges::stable_sort(rows, {}, [](const Row* row) { return row->own ? 0 : row->reference ? 1 : 2; });
  std::vector<LabelledPoint> points;
  for (const Row* row : rows) {
    const double x = std::log(1e3 * row->frame_s / axes.x_low) / std::log(axes.x_high / axes.x_low),
                 y = std::log((row->error.*panel.value > none ? row->error.*panel.value : none) / axes.y_low) /
                     std::log(axes.y_high / axes.y_low);
    points.push_back({.x = x * panel_width_px, .y = y * panel_height_px, .text = label_of(*row)});
  }
  const std::vector<LabelSide> sides = label_sides(points, panel_width_px, panel_height_px);
  std::string text = "unset label\n";
  for (size_t i = 0; i < rows.size(); ++i) {
    if (sides[i] == LabelSide::none) continue;
    const LabelBox box = label_box(points[i], sides[i]);
    const size_t colour = std::ranges::find(series, series_of(*rows[i])) - series.begin();
    text += fmt::format("set label '{}' at graph {:.4f},{:.4f} center noenhanced font ',9' textcolor '{}'\n",
                        plots::quoted(points[i].text), (box.left + box.right) / 2 / panel_width_px,
                        (box.bottom + box.top) / 2 / panel_height_px, plots::colours[colour % plots::colours.size()]);
  }
  return text;
}

// Returns a condition of gnuplot: does a line of the table belong to this series?
std::string belongs(const Study& study, const std::string& series) {
  std::vector<std::string> axes;
  for (const Row& row : study.rows)
    if (row.measured() && series_of(row) == series && std::ranges::find(axes, row.setting.axis) == axes.end())
      axes.push_back(row.setting.axis);
  std::string out;
  for (const std::string& axis : axes)
    out += fmt::format("{}strcol({}) eq '{}'", out.empty() ? "" : " || ", column("axis"), plots::quoted(axis));
  return out;
}

std::string panel_text(const Study& study, const Panel& panel, const std::vector<std::string>& series, bool key) {
  std::string text = fmt::format("set title '{0}' noenhanced\nset ylabel '{0}, share' noenhanced\nset key {1}\nplot ",
                                 panel.title, key ? "at graph 1.05, 1 left top Left reverse noenhanced" : "off");
  for (size_t i = 0; i < series.size(); ++i)
    text += fmt::format(
        "{0}'accuracy.csv' skip 1 using ({1} ? 1e3 * column({2}) : NaN):(column({3}) > {4:g} ? column({3}) : {4:g}) "
        "with points pointtype 7 pointsize 0.8 linecolor '{5}' title '{6}'",
        i == 0 ? "" : ", \\\n  ", belongs(study, series[i]), column("frame_s"), column(panel.column), none,
        plots::colours[i % plots::colours.size()], plots::quoted(series[i]));
  return text + "\n";
}

}  // namespace

std::string page_html(const Study& study, const std::string& command_line, const std::string& svg) {
  study::Heading heading = study::heading_of({}, study.device, command_line);
  heading.scene = study.scene;
  std::string text = fmt::format("<h1>Speed against error: {}</h1>\n{}<h2>What to set</h2>\n<ul>\n",
                                 xml_text(study.config_file), heading_html(heading, {frames_text(study)}));
  for (const std::string& item : recommendations(study)) text += fmt::format("<li>{}</li>\n", xml_text(item));
  text +=
      "</ul>\n<h2>Every setting</h2>\n<p>One axis changes at a time, everything else is as in the configuration. "
      "Losses and errors are against the reference of the axis, which is in bold; rays, auto and reuse share theirs. "
      "Gains are of links that have paths in both; the errors of spreads are means over these links. "
      "On the plot, settings that lose nothing lie at the bottom, and a setting without room for its name has none.</p>\n";
  return html_page("Speed against error", style,
                   text + svg + "<div class=\"wide\">\n" + table_html(study.rows) + "</div>\n");
}

Written write_files(const Study& study, const std::string& command_line, const fs::path& folder) {
  plots::Drawn drawn = plots::draw(front_figure(study), plots::Format::svg, folder);
  const std::string svg =
      drawn.problem.empty() ? study::inline_svg(study::file_text(drawn.files.back()), "accuracy-") : "";
  const std::string page = page_html(study, command_line, svg);
  std::vector<PendingFile> files;
  files.emplace_back(folder / "accuracy.html", std::as_bytes(std::span(page)));
  commit_together(files);
  drawn.files.push_back(files.front().path());
  return {drawn.files, drawn.problem};
}

plots::Figure front_figure(const Study& study) {
  const Axes axes = axes_of(study);
  const std::vector<std::string> series = measured_series(study);
  plots::Figure figure{.name = "accuracy",
                       .title = "",
                       .data = {{"accuracy.csv", encode_csv(study.rows)}},
                       .commands = "",
                       .width_px = width_px,
                       .height_px = height_px};
  figure.commands = fmt::format(
      "set datafile missing NaN\n"
      "set logscale xy\n"
      "set format x '%g'\n"
      "set format y '10^{{%T}}'\n"
      "set xrange [{0:g}:{1:g}]\n"
      "set yrange [{2:g}:{3:g}]\n"
      "set ytics add ('none' {4:g})\n"
      "set xlabel 'time of a frame, ms'\n"
      "set multiplot layout 1,2 title '{5}' noenhanced margins screen {6},{7},{8},{9} spacing screen {10}\n",
      axes.x_low, axes.x_high, axes.y_low, axes.y_high, none,
      plots::quoted(fmt::format("Speed against error, {}", study.device.name)), left, right, bottom, top, between);
  figure.commands += plots::log_tics("x", fmt::format("{:g}", axes.x_low), fmt::format("{:g}", axes.x_high));
  for (const Panel& panel : {Panel{"lost_power", "lost power", &study::PathError::lost_power},
                             Panel{"lost_paths", "lost paths", &study::PathError::lost_share}})
    figure.commands += labels(study, panel, axes, series) +
                       panel_text(study, panel, series, panel.value == &study::PathError::lost_share);
  figure.commands += "unset multiplot\n";
  return figure;
}

}  // namespace wavetracer::accuracy
