// SPDX-License-Identifier: Apache-2.0
// Both axes are logarithmic. In the upper panels of a block times are divided by the rays of all transmitters, because
// a factor of two is small on an axis of four decades; the lower ones have seconds, as in the thesis. It needs
// gnuplot 5.
#include <fmt/format.h>
#include <algorithm>
#include <set>
#include "study/order_rows.hpp"
#include "study/panels.hpp"
#include "study/scripts.hpp"

namespace wavetracer::study {
namespace {

size_t column_number(const std::string& name) { return column_of(names_of(order_columns(false)), name); }

// Each mnemonic of a block has one colour; launch shapes of one method differ in their dashes.
std::string_view colour(const std::vector<Series>& series, size_t index) {
  std::set<std::string> earlier;
  for (const Series& other : series) {
    if (other.mnemonic == series[index].mnemonic) break;
    earlier.insert(other.mnemonic);
  }
  return colours[earlier.size() % colours.size()];
}

// Other numbers of bins are rows of the table and of the report, since their lines could not be told apart.
std::vector<Series> drawn(std::vector<Series> series) {
  std::erase_if(series, [](const Series& one) { return one.bins != thesis_bins; });
  return series;
}

// a_ray: in nanoseconds a ray; else in seconds, as in the thesis.
std::string line(const std::string& name, const std::vector<Series>& series, size_t index, const std::string& column,
                 bool a_ray) {
  const Series& s = series[index];
  const std::string value =
      a_ray ? fmt::format("1e9 * column({}) / column({})", column_number(column), column_number("launched"))
            : fmt::format("column({})", column_number(column));
  const bool own_shape = label(s) == s.mnemonic;
  return fmt::format(
      "'{}.csv' using {}:(strcol({}) eq '{}' && strcol({}) eq '{}' && (column({}) == 0 || column({}) == {}) ? {} : NaN) "
      "with linespoints linecolor '{}' linewidth 1.5 dashtype {} pointtype {} pointsize 0.5 title '{}'",
      name, column_number("rays"), column_number("mnemonic"), s.mnemonic, column_number("shape"), s.shape,
      column_number("bins"), column_number("bins"), s.bins, value, colour(series, index),
      own_shape         ? "1"
      : s.shape == "2d" ? "'-'"
                        : "'.'",
      own_shape ? 7 : 6, label(s));
}

std::string panel(const std::string& name, const std::vector<Series>& series, const std::string& title,
                  const std::string& column, bool a_ray) {
  std::string text = fmt::format("set title '{}'\nplot ", title);
  for (size_t i = 0; i < series.size(); ++i) text += (i == 0 ? "" : ", \\\n  ") + line(name, series, i, column, a_ray);
  return text + "\n";
}

// Divides series into orders, in their own shapes of launch, and launches in other shapes beside their own.
std::vector<std::vector<Series>> series_blocks(const std::vector<Series>& series) {
  const auto is_shaped = [](const Series& one) { return label(one) != one.mnemonic; };
  std::vector<Series> orders, shapes;
  for (const Series& one : series) {
    const bool has_shapes = std::ranges::any_of(
        series, [&](const Series& other) { return is_shaped(other) && other.mnemonic == one.mnemonic; });
    if (!is_shaped(one)) orders.push_back(one);
    if (has_shapes) shapes.push_back(one);
  }
  if (shapes.empty()) return {orders};
  return {orders, shapes};
}

}  // namespace

plots::Figure order_figure(const std::string& name, const std::string& title, const std::vector<Series>& all,
                           const Csv& table) {
  const std::vector<Series> series = drawn(all);
  std::string text = fmt::format(
      "stats '{0}.csv' using {1} skip 1 name 'rays' nooutput\n"
      "stats '{0}.csv' using (1e9 * ${2} / ${4}) skip 1 name 'unpaid' nooutput\n"
      "stats '{0}.csv' using (1e9 * ${3} / ${4}) skip 1 name 'paid' nooutput\n"
      "stats '{0}.csv' using {2} skip 1 name 'least_s' nooutput\n"
      "stats '{0}.csv' using {3} skip 1 name 'most_s' nooutput\n",
      name, column_number("rays"), column_number("unpaid_s"), column_number("paid_s"), column_number("launched"));
  text += fmt::format(
      "set logscale xy\n"
      "set xrange [rays_min / 1.25 : 1.25 * rays_max]\n"
      "set format x '10^{{%T}}'\n"
      "set xlabel 'rays of each transmitter'\n"
      "set multiplot title '{}' noenhanced\n",
      quoted(title));
  const std::vector<std::vector<Series>> blocks = series_blocks(series);
  std::vector<size_t> lines;
  for (const std::vector<Series>& block : blocks) lines.push_back(block.size());
  const PanelPage page(lines, 4, 2);
  const std::string ns_a_ray =
                        "set ylabel 'device time a ray (ns)'\nset format y '%g'\n"
                        "set yrange [0.8 * unpaid_min : 1.25 * paid_max]\n"
                        "do for [k = -3:6] { do for [m in '1 2 5'] { set ytics add (sprintf('%g', m * 10.0**k) m * "
                        "10.0**k) } }\n",
                    seconds =
                        "set ylabel 'device time (s)'\nset ytics autofreq\nset format y '10^{%T}'\n"
                        "set yrange [*:*]\n" +
                        plots::log_tics("y", "least_s_min", "most_s_max");
  for (size_t block = 0; block < blocks.size(); ++block) {
    const auto add = [&](size_t at, const char* title_of, const char* column) {
      text += page.margins(block, at) + panel(name, blocks[block], title_of, column, at < 2);
    };
    text += "set key off\n" + ns_a_ray;
    add(0, "sort not paid", "unpaid_s");
    add(1, "sort paid", "paid_s");
    text += seconds;
    add(2, "sort not paid", "unpaid_s");
    text += page.key(block);
    add(3, "sort paid", "paid_s");
  }
  return experiment_figure(name, table, text + "unset multiplot\n", page_width_px, page.height_px());
}

}  // namespace wavetracer::study
