// SPDX-License-Identifier: Apache-2.0
// Writes the table first, because the plot and the page are made from it. The plot, which needs gnuplot 5.2, has two
// panels on logarithmic axes with one colour per axis; rows that lose nothing lie at the bottom, where the scale says
// "none".
#include "accuracy/files.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <span>
#include "accuracy/advice.hpp"
#include "accuracy/table.hpp"
#include "base/html_page.hpp"
#include "base/pending_file.hpp"
#include "base/xml_text.hpp"
#include "plots/gnuplot.hpp"
#include "study/page.hpp"
#include "study/scripts.hpp"

namespace wavetracer::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr const char* style = "body{max-width:1320px}.own{background:#eef6fb}.reference{font-weight:bold}";

std::string table_html(const std::vector<Row>& rows) {
  std::string text = "<table>\n<thead><tr>" + html_cells(short_columns(), "th") + "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows)
    text += fmt::format("<tr class=\"{}{}\">{}</tr>\n", row.own ? "own " : "", row.reference ? "reference" : "",
                        html_cells(short_cells(row), "td"));
  return text + "</tbody>\n</table>\n";
}

std::string frames_text(const Study& study) {
  const std::string times = fmt::format(
      "the time of a frame is the median of warm frames, each solved {} times, "
      "once where it takes more than two seconds",
      study.repeats);
  if (!study.drive) return fmt::format("one frame with {} links; {}", study.links, times);
  return fmt::format("{} frames spread over the drive, {} links in all, each frame cold but for the rows of reuse; {}",
                     study.frames, study.links, times);
}

constexpr double none = 1e-8;  // share at which 0 and smaller values are drawn

size_t column(const std::string& name) { return study::column_of(csv_columns(), name); }

// Returns the axes with a measured row, in their order.
std::vector<std::string> measured_axes(const Study& study) {
  std::vector<std::string> out;
  for (const Row& row : study.rows)
    if (row.measured() && std::find(out.begin(), out.end(), row.setting.axis) == out.end())
      out.push_back(row.setting.axis);
  return out;
}

std::string panel(const std::vector<std::string>& axes, const std::string& y, const std::string& label, bool key) {
  std::string text = fmt::format("set title '{0}' noenhanced\nset ylabel '{0}, share' noenhanced\nset key {1}\nplot ",
                                 label, key ? "at graph 1.05, 1 left top Left reverse noenhanced" : "off");
  for (size_t i = 0; i < axes.size(); ++i) {
    const std::string points = fmt::format(
        "'accuracy.csv' skip 1 using (strcol({}) eq '{}' ? 1e3 * column({}) : NaN):(column({}) > {:g} ? "
        "column({}) : {:g})",
        column("axis"), plots::quoted(axes[i]), column("frame_s"), column(y), none, column(y), none);
    const std::string_view colour = plots::colours[i % plots::colours.size()];
    text += fmt::format(
        "{}{} with points pointtype 7 pointsize 0.8 linecolor '{}' title '{}', \\\n"
        "  {}:{} with labels noenhanced left rotate by 50 offset 0.3,0.6 font ',9' textcolor '{}' notitle",
        i == 0 ? "" : ", \\\n  ", points, colour, plots::quoted(axes[i]), points, column("setting"), colour);
  }
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
      "On the plot, settings that lose nothing lie at the bottom.</p>\n";
  return html_page("Speed against error", style, text + svg + table_html(study.rows));
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
  double least = 1e300, most = 0;
  for (const Row& row : study.rows)
    if (row.measured()) {
      least = std::min(least, 1e3 * row.frame_s);
      most = std::max(most, 1e3 * row.frame_s);
    }
  const std::vector<std::string> axes = measured_axes(study);
  plots::Figure figure{.name = "accuracy",
                       .title = "",
                       .data = {{"accuracy.csv", encode_csv(study.rows)}},
                       .commands = "",
                       .width_px = 1300,
                       .height_px = 560};
  figure.commands = fmt::format(
      "set datafile missing NaN\n"
      "set logscale xy\n"
      "set format x '%g'\n"
      "set format y '10^{{%T}}'\n"
      "set xrange [{0:g}:{1:g}]\n"
      "set yrange [{2:g}:2]\n"
      "set ytics add ('none' {3:g})\n"
      "set xlabel 'time of a frame, ms'\n"
      "set multiplot layout 1,2 title '{4}' noenhanced margins screen 0.07,0.83,0.13,0.86 spacing screen 0.08\n",
      0.7 * least, 2 * most, 0.5 * none, none,
      plots::quoted(fmt::format("Speed against error, {}", study.device.name)));
  figure.commands += panel(axes, "lost_power", "lost power", false) + panel(axes, "lost_paths", "lost paths", true) +
                     "unset multiplot\n";
  return figure;
}

}  // namespace wavetracer::accuracy
