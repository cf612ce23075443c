// SPDX-License-Identifier: Apache-2.0
// Colours span the gains of all cells except the brightest and darkest percent, which would hide the differences of the
// others. Receivers of a grid must be at their places: a grid does not move.
#include "plots/coverage_plot.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include "base/csv.hpp"
#include "base/times.hpp"
#include "plots/gnuplot.hpp"
#include "radio/grouped_power.hpp"
#include "radio/link_budget.hpp"
#include "radio/path_power.hpp"
#include "simulation/receiver_grid.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::plots {
namespace {

constexpr uint32_t no_cell = std::numeric_limits<uint32_t>::max();

std::string cell_table(const SavedRun& run, const std::vector<CoverageCell>& cells, const RadioConfig& radio) {
  Csv table({"ix", "iy", "x_m", "y_m", "z_m", "path_gain_db", "tx", "paths", "received_dbm", "snr_db"});
  for (const CoverageCell& c : cells) {
    const LinkBudget budget = link_budget(radio, c.path_gain_db);
    table.add(c.ix, c.iy, c.position_m.x, c.position_m.y, c.position_m.z, c.path_gain_db,
              c.tx ? run.transmitters()[*c.tx].name : "", c.paths, budget.received_dbm, budget.snr_db);
  }
  return table.text();
}

// The value that is drawn for a cell: its received power if there is a link budget, else its gain.
struct CellValue {
  double offset_db;  // difference to the path gain
  std::string label, column;
};

CellValue cell_value(const RadioConfig& radio) {
  if (!radio.transmit_power_dbm) return {0, "path gain (dB)", "6"};
  const std::string noise = radio.bandwidth_hz ? fmt::format(", noise {:.1f} dBm", noise_dbm(radio)) : "";
  return {*radio.transmit_power_dbm, "received power (dBm)" + noise, "9"};
}

std::string transmitter_table(const SavedRun& run, const SavedFrame& frame, std::optional<uint32_t> tx) {
  Csv table({"name", "x_m", "y_m", "z_m"});
  for (uint32_t i = 0; i < run.transmitters().size(); ++i)
    if (const glm::dvec3& p = frame.transmitter_position_m[i]; !std::isnan(p.x) && (!tx || *tx == i))
      table.add(run.transmitters()[i].name, p.x, p.y, p.z);
  return table.text();
}

std::string trimmed_range(const std::vector<CoverageCell>& cells, double offset_db) {
  constexpr double span_db = 100, trimmed = 0.01;
  std::vector<double> gains;
  for (const CoverageCell& c : cells)
    if (!std::isnan(c.path_gain_db)) gains.push_back(c.path_gain_db + offset_db);
  std::sort(gains.begin(), gains.end());
  const auto cut = static_cast<std::ptrdiff_t>(trimmed * static_cast<double>(gains.size()));
  return colour_range({gains.begin() + cut, gains.end() - cut}, span_db);
}

// Plots a grid of one row or column.
std::string row_commands(const std::string& name, bool northward, const CellValue& what) {
  return fmt::format(
      "set xlabel '{} (m)'\n"
      "set ylabel '{}'\n"
      "set key off\n"
      "plot '{}.csv' using {}:{} with lines linecolor '#0072b2' linewidth 1.5\n",
      northward ? "y" : "x", what.label, name, northward ? 4 : 3, what.column);
}

std::string image_commands(const std::string& name, const CoverageCell& first, const CoverageCell& last,
                           const CellValue& what) {
  const double half_x_m = 0.5 * (last.position_m.x - first.position_m.x) / last.ix,
               half_y_m = 0.5 * (last.position_m.y - first.position_m.y) / last.iy;
  return fmt::format(
      "set size ratio -1\n"
      "set border 15\n"
      "unset grid\n"
      "set xrange [{1}:{2}]\n"
      "set yrange [{3}:{4}]\n"
      "set xlabel 'x (m)'\n"
      "set ylabel 'y (m)'\n"
      "set cblabel '{5}'\n"
      "set key off\n"
      "set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor '#e8e8e8' fillstyle solid noborder\n"
      "plot '{0}.csv' using 3:4:{6} with image, \\\n"
      "  '{0}_walls.csv' using 1:2:($3 - $1):($4 - $2) with vectors nohead linecolor '#333333' linewidth 0.6, \\\n"
      "  '{0}_transmitters.csv' using 2:3 with points pointtype 9 pointsize 1.8 linecolor '#ffffff', \\\n"
      "  '' using 2:3 with points pointtype 9 pointsize 1.2 linecolor '#d55e00', \\\n"
      "  '' using 2:3:1 with labels noenhanced left offset 1,0.6 textcolor '#000000'\n",
      name, first.position_m.x - half_x_m, last.position_m.x + half_x_m, first.position_m.y - half_y_m,
      last.position_m.y + half_y_m, what.label, what.column);
}

}  // namespace

std::vector<CoverageCell> coverage_cells(const SavedRun& run, const SavedFrame& frame, const std::string& grid,
                                         std::optional<uint32_t> tx) {
  std::vector<CoverageCell> cells;
  std::vector<uint32_t> cell_of(run.receivers().size(), no_cell);
  for (uint32_t rx = 0; rx < run.receivers().size(); ++rx) {
    const auto place = grid_cell(grid, run.receivers()[rx].name);
    if (!place) continue;
    cell_of[rx] = static_cast<uint32_t>(cells.size());
    cells.push_back({place->ix, place->iy, frame.receiver_position_m[rx], 0, {}, 0});
  }
  if (cells.empty()) return cells;
  std::vector<double> best(cells.size(), 0);
  const Paths& paths = frame.paths;
  for (size_t first = 0, end = 0; first < paths.size(); first = end) {
    end = end_of_link(paths, first);
    const uint32_t k = cell_of[paths.rx[first]];
    if (k == no_cell || (tx && *tx != paths.tx[first])) continue;
    const double power = grouped_power(paths, first, end, run.frequency_hz());
    cells[k].paths += static_cast<uint32_t>(end - first);
    if (power <= best[k]) continue;
    best[k] = power;
    cells[k].tx = paths.tx[first];
  }
  for (size_t k = 0; k < cells.size(); ++k) cells[k].path_gain_db = best[k] > 0 ? 10 * std::log10(best[k]) : NAN;
  std::stable_sort(cells.begin(), cells.end(), [](const CoverageCell& a, const CoverageCell& b) {
    return std::pair(a.iy, a.ix) < std::pair(b.iy, b.ix);
  });
  const uint64_t columns = uint64_t{cells.back().ix} + 1;
  for (size_t k = 0; k < cells.size(); ++k)
    if (cells[k].ix != k % columns || cells[k].iy != k / columns || cells.size() % columns != 0)
      throw InputError(
          fmt::format("{}: receivers of the grid \"{}\" are missing, or there twice", run.file().string(), grid));
  return cells;
}

std::vector<std::array<double, 4>> section(const Scene& scene, double height_m) {
  std::vector<std::array<double, 4>> out;
  const double z = height_m - scene.origin_m.z;
  for (const auto& corners : scene.triangles) {
    std::vector<glm::dvec3> points;  // points where sides cross the plane: none or two
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 &a = scene.vertices[corners[k]], &b = scene.vertices[corners[(k + 1) % 3]];
      if ((a.z < z) != (b.z < z)) points.push_back(scene.origin_m + a + (z - a.z) / (b.z - a.z) * (b - a));
    }
    if (points.size() == 2) out.push_back({points[0].x, points[0].y, points[1].x, points[1].y});
  }
  return out;
}

std::string wall_table(const std::vector<std::array<double, 4>>& walls) {
  Csv table({"x0_m", "y0_m", "x1_m", "y1_m"});
  for (const auto& [x0, y0, x1, y1] : walls) table.add(x0, y0, x1, y1);
  return table.text();
}

Figure coverage_figure(const SavedRun& run, const SavedFrame& frame, const std::string& name, const std::string& grid,
                       const std::vector<CoverageCell>& cells, std::optional<uint32_t> tx, const Scene& scene,
                       const RadioConfig& radio) {
  const std::string by = tx                               ? run.transmitters()[*tx].name
                         : run.transmitters().size() == 1 ? run.transmitters()[0].name
                                                          : fmt::format("the best of {}", run.transmitters().size());
  const std::string time = run.frame_count() > 1 ? fmt::format(", {} s", time_text(frame.time_s)) : "";
  Figure out{name,
             fmt::format("Coverage of {} by {}{}", grid, by, time),
             {{name + ".csv", cell_table(run, cells, radio)}},
             ""};
  const CoverageCell &first = cells.front(), &last = cells.back();
  if (last.ix == 0 || last.iy == 0) {
    out.commands = row_commands(name, last.iy > 0, cell_value(radio));
    return out;
  }
  const double z_m = 0.5 * (first.position_m.z + last.position_m.z);
  out.data.push_back({name + "_walls.csv", wall_table(section(scene, z_m))});
  out.data.push_back({name + "_transmitters.csv", transmitter_table(run, frame, tx)});
  out.commands =
      trimmed_range(cells, cell_value(radio).offset_db) + image_commands(name, first, last, cell_value(radio));
  out.height_px = std::clamp(690.0 * (last.iy + 1) / (last.ix + 1) + 120, 300.0, 1200.0);
  return out;
}

}  // namespace wavetracer::plots
