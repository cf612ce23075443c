// Correlations and shares: every axis ends at 1 and begins a little below 0, or where the values do.
// Assumes gnuplot 5.
#include "study/depth_plot.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <stdexcept>
#include "study/plot.hpp"

namespace wavetracer::study {
namespace {

size_t column(const DepthPlot& plot, const std::string& name) {
  const auto found = std::find(plot.columns.begin(), plot.columns.end(), name);
  if (found == plot.columns.end()) throw std::logic_error("no column is called " + name);
  return found - plot.columns.begin() + 1;  // as gnuplot counts
}

std::string panel_text(const DepthPlot& plot, const DepthPanel& panel) {
  std::string text = fmt::format("set title {}\nplot ", "'" + quoted(panel.title) + "'");
  for (uint32_t depth = 1; depth <= plot.max_depth; ++depth)
    text += fmt::format(
        "{}'{}.csv' using {}:(strcol({}) eq '{}' && column({}) == {} ? column({}) : NaN) with {} linecolor '{}' "
        "title 'depth {}'",
        depth == 1 ? "" : ", \\\n  ", plot.name, column(plot, panel.x), column(plot, panel.only), quoted(panel.equals),
        column(plot, "depth"), depth, column(plot, panel.y),
        plot.points ? "points pointtype 7 pointsize 0.2" : "lines linewidth 1.5", colours[(depth - 1) % colours.size()],
        depth);
  return text + "\n";
}

}  // namespace

std::string depth_plot_script(const DepthPlot& plot) {
  const size_t rows = (plot.panels.size() + plot.panels_a_row - 1) / plot.panels_a_row;
  std::string text = fmt::format(
      "# Draws {0}.csv; run it in its folder: gnuplot {0}.gp\n"
      "set terminal svg size 1150,{1} font 'sans-serif,13' background 'white'\n"
      "set output '{0}.svg'\n"
      "set datafile separator ','\n"
      "set datafile missing NaN\n"
      "set key off\n"
      "{2}"
      "set yrange [*<-0.05:1.05]\n"
      "set autoscale yfixmin\n"
      "set ytics 0.2\n"
      "set xlabel '{3}'\n"
      "set ylabel '{4}'\n"
      "set grid linecolor '#dddddd'\n"
      "set border 3\n"
      "set tics nomirror\n"
      "set multiplot layout {5},{6} title '{7}' noenhanced margins screen 0.07,0.88,0.1,0.88 "
      "spacing screen 0.06,0.16\n",
      plot.name, 80 + 340 * rows, plot.log_x ? "set logscale x\n" : "", quoted(plot.x_label), quoted(plot.y_label),
      rows, plot.panels_a_row, quoted(plot.title));
  for (const DepthPanel& panel : plot.panels) {
    if (&panel == &plot.panels.back()) text += "set key at screen 0.99, 0.88 right top Left reverse\n";
    text += panel_text(plot, panel);
  }
  return text + "unset multiplot\n";
}

}  // namespace wavetracer::study
