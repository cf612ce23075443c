// A row of panels a drive, as the figures order them; the key stands on the right.
// Assumes gnuplot 5.
#include "study/line_plot.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <stdexcept>
#include "study/plot.hpp"

namespace wavetracer::study {
namespace {

bool has(const LinePlot& plot, const std::string& name) {
  return std::find(plot.columns.begin(), plot.columns.end(), name) != plot.columns.end();
}

size_t column(const LinePlot& plot, const std::string& name) {
  if (!has(plot, name)) throw std::logic_error("no column is called " + name);
  return std::find(plot.columns.begin(), plot.columns.end(), name) - plot.columns.begin() + 1;  // as gnuplot counts
}

std::string line_text(const LinePlot& plot, const LinePanel& panel, size_t index) {
  const size_t y = column(plot, panel.y);
  std::string condition = fmt::format("strcol({}) eq '{}'", column(plot, "setting"), quoted(plot.settings[index]));
  if (!panel.drive.empty())
    condition += fmt::format(" && strcol({}) eq '{}'", column(plot, "drive"), quoted(panel.drive));
  if (plot.only_rays > 0) condition += fmt::format(" && column({}) == {}", column(plot, "rays"), plot.only_rays);
  if (has(plot, "depth"))
    condition += fmt::format(" && column({}) {} 0", column(plot, "depth"), plot.depths ? ">" : "==");
  const std::string value = panel.log_y && panel.least > 0
                                ? fmt::format("column({}) > {:g} ? column({}) : {:g}", y, panel.least, y, panel.least)
                                : fmt::format("column({})", y);
  const size_t x = column(plot, plot.x);
  const std::string place =
      plot.least_x ? fmt::format("(column({}) > {:g} ? column({}) : {:g})", x, *plot.least_x, x, *plot.least_x)
                   : std::to_string(x);
  return fmt::format(
      "'{}.csv' using {}:({} ? ({}) : NaN) with {} linecolor '{}' linewidth 1.5 dashtype {} pointtype "
      "{} pointsize 0.6 title '{}'",
      plot.name, place, condition, value, plot.points ? "points" : "linespoints", colours[index % colours.size()],
      index / colours.size() + 1, index < colours.size() ? 7 : 6, quoted(plot.settings[index]));
}

// Ranges of the whole table, so that panels of one quantity agree; an axis without any value would be an error.
std::string statistics(const LinePlot& plot) {
  std::string text = fmt::format("stats '{}.csv' using {} skip 1 name 'x' nooutput\n", plot.name, column(plot, plot.x));
  for (size_t i = 0; i < plot.panels.size(); ++i)
    if (plot.panels[i].least > 0)
      text += fmt::format("stats '{}.csv' using {} skip 1 name 'y{}' nooutput\n", plot.name,
                          column(plot, plot.panels[i].y), i);
  return text;
}

std::string y_range(const LinePanel& panel, size_t index) {
  if (panel.least <= 0) return "[*:*]";
  return panel.log_y ? fmt::format("[{0:g} : (y{1}_max > {2:g} ? 2 * y{1}_max : {2:g})]", panel.least / 2, index,
                                   10 * panel.least)
                     : fmt::format("[0 : (y{0}_max > {1:g} ? 1.05 * y{0}_max : {1:g})]", index, panel.least);
}

std::string panel_text(const LinePlot& plot, size_t index) {
  const LinePanel& panel = plot.panels[index];
  std::string text = fmt::format(
      "{}set logscale y\nset format y '{}'\nset yrange {}\nset title '{}' noenhanced\nset ylabel '{}' noenhanced\n"
      "plot ",
      panel.log_y ? "" : "un", panel.log_y ? "10^{%T}" : "%g", y_range(panel, index), quoted(panel.title),
      quoted(panel.y_label));
  for (size_t i = 0; i < plot.settings.size(); ++i) text += (i == 0 ? "" : ", \\\n  ") + line_text(plot, panel, i);
  return text + "\n";
}

std::string x_axis(const LinePlot& plot) {
  if (plot.log_x) return "set logscale x\nset format x '10^{%T}'\nset xrange [x_min / 1.25 : 1.25 * x_max]\n";
  if (plot.least_x) return fmt::format("set xrange [{:g} : (x_max > 0 ? 1.05 * x_max : 0) + 5]\n", *plot.least_x - 5);
  return plot.depths ? "set xtics 1\nset xrange [0.5 : x_max + 0.5]\n" : "set xrange [x_min - 0.5 : x_max + 0.5]\n";
}

}  // namespace

std::string line_plot_script(const LinePlot& plot) {
  const size_t rows = (plot.panels.size() + plot.panels_a_row - 1) / plot.panels_a_row;
  const size_t height = 120 + 340 * rows;  // pixels; margins are 60 and 75 of them, gaps 105
  const auto part = [height](double pixels) { return pixels / static_cast<double>(height); };
  std::string text = fmt::format(
      "# Draws {0}.csv; run it in its folder: gnuplot {0}.gp\n"
      "set terminal svg size 1250,{1} font 'sans-serif,13' background 'white'\n"
      "set output '{0}.svg'\n"
      "set datafile separator ','\n"
      "set datafile missing NaN\n"
      "{2}"
      "set key off\n"
      "{3}"
      "set xlabel '{4}'\n"
      "set grid linecolor '#dddddd'\n"
      "set border 3\n"
      "set tics nomirror\n"
      "set multiplot layout {5},{6} title '{7}' noenhanced margins screen 0.07,0.80,{8:.3f},{9:.3f} "
      "spacing screen 0.07,{10:.3f}\n",
      plot.name, height, statistics(plot), x_axis(plot), quoted(plot.x_label), rows, plot.panels_a_row,
      quoted(plot.title), part(60), 1 - part(75), part(105));
  for (size_t i = 0; i < plot.panels.size(); ++i) {
    if (i + 1 == plot.panels.size())
      text += fmt::format("set key at screen 0.995, {:.3f} right top Left reverse noenhanced maxrows 40 font ',11'\n",
                          1 - part(75));
    text += panel_text(plot, i);
  }
  return text + "unset multiplot\n";
}

}  // namespace wavetracer::study
