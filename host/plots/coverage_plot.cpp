// SPDX-License-Identifier: Apache-2.0
// Colours span the values of all cells except the brightest and darkest percent, which would hide the differences of
// the others.
#include "plots/coverage_plot.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <span>
#include "base/colours.hpp"
#include "base/csv.hpp"
#include "base/times.hpp"
#include "coverage/png.hpp"
#include "coverage/write_map.hpp"
#include "plots/gnuplot.hpp"
#include "radio/link_budget.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::plots {
namespace {

constexpr const char* empty_colour = "#e8e8e8";

// On a vertical plane only transmitters within a cell of it are marked: others are not where their marks would be.
std::string transmitter_table(const SavedRun& run, const SavedFrame& frame, const coverage::Map& map) {
  const auto& plane = map.plane;
  Csv table(plane ? std::vector<std::string>{"name", "along_m", "z_m"}
                  : std::vector<std::string>{"name", "x_m", "y_m", "z_m"});
  for (uint32_t i = 0; i < run.transmitters().size(); ++i) {
    const glm::dvec3& p = frame.transmitter_position_m[i];
    if (std::isnan(p.x) || (map.tx && *map.tx != i)) continue;
    if (!plane)
      table.add(run.transmitters()[i].name, p.x, p.y, p.z);
    else if (const glm::dvec2 at = plane->along_and_off_m(p.x, p.y); std::abs(at.y) <= map.step_m.x)
      table.add(run.transmitters()[i].name, at.x, p.z);
  }
  return table.text();
}

// The axes of a map in its figure: their names, and their columns in the table, counted from 1.
struct MapAxes {
  const char *across, *up;
  int across_column, up_column;
};

MapAxes axes_of(const coverage::Map& map) {
  if (map.plane) return {"along", "z", 6, 5};
  return {"x", "y", 3, 4};
}

std::string label_of(const coverage::LayerKind& layer, const RadioConfig& radio) {
  const std::string noise =
      layer.of_powers && radio.bandwidth_hz ? fmt::format(", noise {:.1f} dBm", noise_dbm(radio)) : "";
  return layer.unit.empty() ? std::string(layer.words) : fmt::format("{} ({}){}", layer.words, layer.unit, noise);
}

// Returns the palette and the marks of values that are choices: names of transmitters, no and yes, or numbers of beams.
std::string choice_colours(const std::vector<std::string>& names, std::span<const Colour> colours) {
  constexpr size_t most_marks = 20;  // more names would overlap
  const size_t step = (names.size() + most_marks - 1) / most_marks;
  std::string steps, marks;
  for (size_t k = 0; k < names.size(); ++k) {
    const std::string colour = "'" + hex(colours[k % colours.size()]) + "'", between = k == 0 ? "" : ", ";
    steps += fmt::format("{}{} {}, {} {}", between, k, colour, k + 1, colour);
    if (k % step == 0) marks += fmt::format("{}'{}' {}", between, quoted(names[k]), k);
  }
  return fmt::format("set palette defined ({})\nset cbrange [-0.5:{}]\nset cbtics noenhanced ({})\n", steps,
                     static_cast<double>(names.size()) - 0.5, marks);
}

// Returns a name for each beam up to the largest number that a cell has.
std::vector<std::string> beam_names(std::span<const double> values) {
  double last = 0;
  for (const double value : values)
    if (value > last) last = value;
  std::vector<std::string> out;
  while (static_cast<double>(out.size()) <= last) out.push_back(std::to_string(out.size()));
  return out;
}

std::string colours_of(const coverage::Map& map, const coverage::LayerKind& layer) {
  if (layer.value == &coverage::Cell::best_server)
    return choice_colours(map.transmitters, coverage::choice_colours(layer));
  if (layer.value == &coverage::Cell::line_of_sight)
    return choice_colours({"other paths only", "line of sight"}, coverage::choice_colours(layer));
  if (layer.of_pair()) return choice_colours(beam_names(map.values(layer)), coverage::choice_colours(layer));
  const coverage::ColourRange range = coverage::colour_range(layer, map.values(layer));
  return fmt::format("set palette negative\nset cbrange [{:g}:{:g}]\n", range.low, range.high);
}

// Returns the column of the table that has the layer, counted from 1.
size_t column_of(const coverage::Map& map, const coverage::LayerKind& layer) {
  const size_t first = map.plane ? 7 : 6;
  return first + static_cast<size_t>(std::ranges::find(map.layers, &layer) - map.layers.begin());
}

// Plots a grid of one row or column.
std::string row_commands(const std::string& name, const coverage::Map& map, const coverage::LayerKind& layer,
                         const RadioConfig& radio) {
  const bool upward = map.rows > 1;
  const MapAxes axes = axes_of(map);
  return fmt::format(
      "set xlabel '{} (m)'\n"
      "set ylabel '{}'\n"
      "set key off\n"
      "plot '{}.csv' using {}:{} with lines linecolor '#0072b2' linewidth 1.5\n",
      upward ? axes.up : axes.across, label_of(layer, radio), name, upward ? axes.up_column : axes.across_column,
      column_of(map, layer));
}

// Returns the parts of the plot that draw walls and transmitters, as far as their tables have rows; gnuplot warns of
// tables without any.
std::string mark_commands(const std::string& name, const std::string& walls, const std::string& transmitters) {
  const auto has_rows = [](const std::string& table) { return std::ranges::count(table, '\n') > 1; };
  std::string out;
  if (has_rows(walls))
    out += fmt::format(
        ", \\\n  '{}_walls.csv' using 1:2:($3 - $1):($4 - $2) with vectors nohead linecolor '#333333' linewidth 0.6 "
        "notitle",
        name);
  if (has_rows(transmitters))
    out += fmt::format(
        ", \\\n  '{}_transmitters.csv' using 2:3 with points pointtype 9 pointsize 1.8 linecolor '#ffffff' notitle, "
        "\\\n"
        "  '' using 2:3 with points pointtype 9 pointsize 1.2 linecolor '#d55e00' notitle, \\\n"
        "  '' using 2:3:1 with labels noenhanced left offset 1,0.6 textcolor '#000000' notitle",
        name);
  return out;
}

// marks: what is drawn over the image. Infinite values have the brightest or the darkest colour.
std::string image_commands(const std::string& name, const coverage::Map& map, const coverage::LayerKind& layer,
                           const RadioConfig& radio, const std::string& marks) {
  const glm::dvec2 first_m = map.plane ? glm::dvec2(map.plane->first_along_m, map.plane->first_z_m) : map.first_m,
                   low_m = first_m - 0.5 * map.step_m;
  const MapAxes axes = axes_of(map);
  const std::vector<double> values = map.values(layer);
  const bool holes = std::ranges::any_of(values, [](double value) { return std::isnan(value); });
  constexpr double most = 1e9;
  return fmt::format(
             "set size ratio -1\n"
             "set border 15\n"
             "unset grid\n"
             "set xrange [{}:{}]\n"
             "set yrange [{}:{}]\n"
             "set xlabel '{} (m)'\n"
             "set ylabel '{} (m)'\n"
             "set cblabel '{}'\n"
             "set key outside right bottom horizontal\n"
             "set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor '{}' fillstyle solid noborder\n",
             low_m.x, low_m.x + map.columns * map.step_m.x, low_m.y, low_m.y + map.rows * map.step_m.y, axes.across,
             axes.up, label_of(layer, radio), empty_colour) +
         fmt::format(
             "plot '{0}.csv' using {4}:{5}:(${1} > {2:g} ? {2:g} : ${1} < -{2:g} ? -{2:g} : ${1}) with image notitle{6}{3}\n",
             name, column_of(map, layer), most,
             holes ? fmt::format(", \\\n  1/0 with boxes fillstyle solid border linecolor '#888888' fillcolor '{}' "
                                 "title 'no value, as where no path leads'",
                                 empty_colour)
                   : "",
             axes.across_column, axes.up_column, marks);
}

// Returns the two points, in file coordinates, of each triangle that a plane cuts. height: the distance of a vertex
// from the plane, with a sign.
std::vector<std::array<glm::dvec3, 2>> cuts(const Scene& scene, const auto& height) {
  std::vector<std::array<glm::dvec3, 2>> out;
  for (const auto& corners : scene.triangles) {
    std::vector<glm::dvec3> points;  // points where sides cross the plane: none or two
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 &a = scene.vertices[corners[k]], &b = scene.vertices[corners[(k + 1) % 3]];
      const double from = height(a), to = height(b);
      if ((from < 0) != (to < 0)) points.push_back(scene.origin_m + a + from / (from - to) * (b - a));
    }
    if (points.size() == 2) out.push_back({points[0], points[1]});
  }
  return out;
}

}  // namespace

const coverage::LayerKind& shown_layer(const std::string& name, const RadioConfig& radio) {
  if (name.empty()) return coverage::layer_kind(radio.transmit_power_dbm ? "received_dbm" : "path_gain_db");
  return coverage::layer_kind(name);
}

std::vector<std::array<double, 4>> section(const Scene& scene, double height_m) {
  const double z = height_m - scene.origin_m.z;
  std::vector<std::array<double, 4>> out;
  for (const auto& [a, b] : cuts(scene, [z](const glm::dvec3& p) { return p.z - z; }))
    out.push_back({a.x, a.y, b.x, b.y});
  return out;
}

std::vector<std::array<double, 4>> section(const Scene& scene, const coverage::VerticalPlane& plane) {
  const auto at = [&](const glm::dvec3& p) { return plane.along_and_off_m(p.x, p.y); };
  std::vector<std::array<double, 4>> out;
  for (const auto& [a, b] : cuts(scene, [&](const glm::dvec3& p) { return at(scene.origin_m + p).y; }))
    out.push_back({at(a).x, a.z, at(b).x, b.z});
  return out;
}

std::string wall_table(const std::vector<std::array<double, 4>>& walls, bool upright) {
  Csv table(upright ? std::vector<std::string>{"along0_m", "z0_m", "along1_m", "z1_m"}
                    : std::vector<std::string>{"x0_m", "y0_m", "x1_m", "y1_m"});
  for (const auto& [x0, y0, x1, y1] : walls) table.add(x0, y0, x1, y1);
  return table.text();
}

Figure coverage_figure(const SavedRun& run, const SavedFrame& frame, const std::string& name, const coverage::Map& map,
                       const coverage::LayerKind& layer, const Scene& scene, const RadioConfig& radio) {
  const std::string by = map.tx                           ? run.transmitters()[*map.tx].name
                         : run.transmitters().size() == 1 ? run.transmitters()[0].name
                                                          : fmt::format("the best of {}", run.transmitters().size());
  const std::string time = run.frame_count() > 1 ? fmt::format(", {} s", time_text(frame.time_s)) : "";
  Figure out{name,
             fmt::format("Coverage of {} by {}{}", map.grid, by, time),
             {{name + ".csv", coverage::table_of(map, {})}},
             ""};
  if (map.columns == 1 || map.rows == 1) {
    out.commands = row_commands(name, map, layer, radio);
    return out;
  }
  const double z_m = 0.5 * (map.z_m.front() + map.z_m.back());
  const std::string transmitters = transmitter_table(run, frame, map),
                    walls =
                        wall_table(map.plane ? section(scene, *map.plane) : section(scene, z_m), map.plane.has_value());
  out.data.push_back({name + "_walls.csv", walls});
  out.data.push_back({name + "_transmitters.csv", transmitters});
  out.commands =
      colours_of(map, layer) + image_commands(name, map, layer, radio, mark_commands(name, walls, transmitters));
  out.height_px = std::clamp(690.0 * map.rows / map.columns + 120, 300.0, 1200.0);
  return out;
}

}  // namespace wavetracer::plots
