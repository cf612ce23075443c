// SPDX-License-Identifier: Apache-2.0
// Panels are in the order of the figures; panels.hpp places them, with a key below each block.
// It needs gnuplot 5.
#include "study/scripts.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <stdexcept>
#include "study/panels.hpp"

namespace wavetracer::study {
namespace {

using Names = std::vector<std::string>;

// index: of the setting in its block, which decides the colour.
std::string line_text(const LinePlot& plot, const Names& names, const LinePanel& panel, const std::string& setting,
                      size_t index) {
  const size_t y = column_of(names, panel.y);
  std::string condition = fmt::format("strcol({}) eq '{}'", column_of(names, plot.line_column), quoted(setting));
  if (!panel.drive.empty())
    condition += fmt::format(" && strcol({}) eq '{}'", column_of(names, plot.panel_column), quoted(panel.drive));
  if (plot.only_rays > 0) condition += fmt::format(" && column({}) == {}", column_of(names, "rays"), plot.only_rays);
  if (std::ranges::find(names, "depth") != names.end())
    condition += fmt::format(" && column({}) == 0", column_of(names, "depth"));
  const std::string value = panel.log_y && panel.least > 0
                                ? fmt::format("column({}) > {:g} ? column({}) : {:g}", y, panel.least, y, panel.least)
                                : fmt::format("column({})", y);
  const size_t x = column_of(names, plot.x);
  const std::string place =
      plot.least_x ? fmt::format("(column({}) > {:g} ? column({}) : {:g})", x, *plot.least_x, x, *plot.least_x)
                   : std::to_string(x);
  const bool points = plot.points && std::ranges::find(plot.joined, setting) == plot.joined.end();
  return fmt::format(
      "'{}.csv' using {}:({} ? ({}) : NaN) with {} linecolor '{}' linewidth 1.5 pointtype 7 pointsize {:g} title '{}'",
      plot.name, place, condition, value, points ? "points" : "linespoints", colours[index % colours.size()],
      plot.point_size, quoted(setting));
}

// Computes ranges of the whole table, so that panels of one quantity agree; an axis without any value would be an
// error. Logarithms need values above 0.
std::string statistics(const LinePlot& plot, const Names& names) {
  std::string text =
      fmt::format("stats '{}.csv' using {} skip 1 name 'x' nooutput\n", plot.name, column_of(names, plot.x));
  for (size_t i = 0; i < plot.panels.size(); ++i) {
    const LinePanel& panel = plot.panels[i];
    const size_t y = column_of(names, panel.y);
    if (panel.least > 0)
      text += fmt::format("stats '{}.csv' using {} skip 1 name 'y{}' nooutput\n", plot.name, y, i);
    else if (panel.log_y)
      text += fmt::format("stats '{}.csv' using (column({}) > 0 ? column({}) : NaN) skip 1 name 'y{}' nooutput\n",
                          plot.name, y, y, i);
  }
  return text;
}

// Labels of an axis of few decades are not at its powers of ten alone.
std::string y_tics(const LinePanel& panel, size_t index) {
  if (!panel.log_y) return "set ytics autofreq\n";
  const std::string low = panel.least > 0 ? fmt::format("{:g}", panel.least / 2) : fmt::format("y{}_min", index);
  return "set ytics autofreq\n" + plots::log_tics("y", low, fmt::format("y{}_max", index));
}

std::string y_range(const LinePanel& panel, size_t index) {
  if (panel.least <= 0) return "[*:*]";
  return panel.log_y ? fmt::format("[{0:g} : (y{1}_max > {2:g} ? 2 * y{1}_max : {2:g})]", panel.least / 2, index,
                                   10 * panel.least)
                     : fmt::format("[0 : (y{0}_max > {1:g} ? 1.05 * y{0}_max : {1:g})]", index, panel.least);
}

std::string panel_text(const LinePlot& plot, const Names& names, size_t index,
                       const std::vector<std::string>& settings) {
  const LinePanel& panel = plot.panels[index];
  std::string text = fmt::format(
      "{}set logscale y\nset format y '{}'\nset yrange {}\n{}set title '{}' noenhanced\nset ylabel '{}' noenhanced\n"
      "plot ",
      panel.log_y ? "" : "un", panel.log_y ? "10^{%T}" : "%g", y_range(panel, index), y_tics(panel, index),
      quoted(panel.title), quoted(panel.y_label));
  for (size_t i = 0; i < settings.size(); ++i)
    text += (i == 0 ? "" : ", \\\n  ") + line_text(plot, names, panel, settings[i], i);
  return text + "\n";
}

std::string x_axis(const LinePlot& plot) {
  if (plot.log_x)
    return "set logscale x\nset format x '10^{%T}'\nset xrange [x_min / 1.25 : 1.25 * x_max]\n" +
           plots::log_tics("x", "x_min", "x_max");
  if (plot.least_x) return fmt::format("set xrange [{:g} : (x_max > 0 ? 1.05 * x_max : 0) + 5]\n", *plot.least_x - 5);
  return std::string(plot.x_in_thousands ? "set format x '%.0s%c'\n" : "") + "set xrange [x_min - 0.5 : x_max + 0.5]\n";
}

// For correlations and shares: every axis ends at 1 and begins a little below 0, or at the smallest value.
std::string panel_text(const DepthPlot& plot, const Names& names, const DepthPanel& panel) {
  std::string text = fmt::format("set title '{}'\nplot ", quoted(panel.title));
  for (uint32_t depth = 1; depth <= plot.max_depth; ++depth)
    text += fmt::format(
        "{}'{}.csv' using {}:(strcol({}) eq '{}' && column({}) == {} ? "
        "column({}) : NaN) with {} linecolor '{}' title 'depth {}'",
        depth == 1 ? "" : ", \\\n  ", plot.name, column_of(names, panel.x), column_of(names, panel.only),
        quoted(panel.equals), column_of(names, "depth"), depth, column_of(names, panel.y),
        plot.points ? "points pointtype 7 pointsize 0.2" : "lines linewidth 1.5", colours[(depth - 1) % colours.size()],
        depth);
  return text + "\n";
}

}  // namespace

size_t column_of(const std::vector<std::string>& columns, const std::string& name) {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) throw std::logic_error("no column is called " + name);
  return found - columns.begin() + 1;
}

plots::Figure experiment_figure(const std::string& name, const Csv& table, const std::string& commands, double width_px,
                                double height_px) {
  return {.name = name,
          .title = "",
          .data = {{name + ".csv", table.text()}},
          .commands = "set datafile missing NaN\n" + commands,
          .width_px = width_px,
          .height_px = height_px};
}

plots::Figure line_figure(const LinePlot& plot, const Csv& table) {
  const std::vector<std::vector<std::string>> blocks = line_blocks(plot.settings);
  std::vector<size_t> lines;
  for (const std::vector<std::string>& block : blocks) lines.push_back(block.size());
  const PanelPage page(lines, plot.panels.size(), plot.panels_a_row);
  std::string text =
      statistics(plot, table.names()) + x_axis(plot) +
      fmt::format("set xlabel '{}'\nset multiplot title '{}' noenhanced\n", quoted(plot.x_label), quoted(plot.title));
  for (size_t block = 0; block < blocks.size(); ++block)
    for (size_t i = 0; i < plot.panels.size(); ++i)
      text += (i + 1 == plot.panels.size() ? page.key(block) : "set key off\n") + page.margins(block, i) +
              panel_text(plot, table.names(), i, blocks[block]);
  return experiment_figure(plot.name, table, text + "unset multiplot\n", page_width_px, page.height_px());
}

plots::Figure depth_figure(const DepthPlot& plot, const Csv& table) {
  const PanelPage page({plot.max_depth}, plot.panels.size(), plot.panels_a_row);
  std::string text =
      (plot.log_x ? "set logscale x\n" : "set xrange [0:*]\n") +
      fmt::format(
          "set yrange [*<-0.05:1.05]\nset autoscale yfixmin\nset ytics 0.2\nset xlabel '{}'\nset multiplot title '{}' "
          "noenhanced\n",
          quoted(plot.x_label), quoted(plot.title));
  for (size_t i = 0; i < plot.panels.size(); ++i)
    text += (i + 1 == plot.panels.size() ? page.key(0) : "set key off\n") + page.margins(0, i) +
            panel_text(plot, table.names(), plot.panels[i]);
  return experiment_figure(plot.name, table, text + "unset multiplot\n", page_width_px, page.height_px());
}

}  // namespace wavetracer::study
