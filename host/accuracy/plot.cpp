// SPDX-License-Identifier: Apache-2.0
// Two panels on logarithmic axes, one colour per axis. Rows that lose nothing lie at the bottom, where the scale says
// "none". It needs gnuplot 5.2.
#include <fmt/format.h>
#include <algorithm>
#include "accuracy/files.hpp"
#include "accuracy/table.hpp"
#include "plots/gnuplot.hpp"
#include "study/scripts.hpp"

namespace wavetracer::accuracy {
namespace {

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
