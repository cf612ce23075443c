// SPDX-License-Identifier: Apache-2.0
// Each cell is a row of the table. Powers below the range of colours, and none at all, get the darkest colour.
#include "plots/radar_plot.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "base/csv.hpp"

namespace wavetracer::plots {
namespace {

constexpr double shown_db = 70;
constexpr double least_dbm = -999;  // stands for no power, which gnuplot would leave out

std::string map_table(const RadarMap& map, const std::string& row, const std::string& column) {
  Csv table({row, column, "power_dbm"});
  for (size_t r = 0; r < map.rows.size(); ++r)
    for (size_t c = 0; c < map.columns.size(); ++c)
      table.add(map.rows[r], map.columns[c], std::max(map.power_dbm[r * map.columns.size() + c], least_dbm));
  return table.text();
}

// across, up: the columns of the table on the axes.
std::string map_commands(const std::string& name, const std::vector<double>& powers, const char* across_label,
                         const char* up_label, int across, int up) {
  return colour_range(powers, shown_db) + fmt::format(
                                              "set border 15\n"
                                              "unset grid\n"
                                              "set autoscale xfix\n"
                                              "set autoscale yfix\n"
                                              "set xlabel '{}'\n"
                                              "set ylabel '{}'\n"
                                              "set cblabel 'power (dBm)'\n"
                                              "set key off\n"
                                              "plot '{}.csv' using {}:{}:3 with image\n",
                                              across_label, up_label, name, across, up);
}

}  // namespace

bool has_power(const RadarMap& map) {
  return std::ranges::any_of(map.power_dbm, [](double power) { return std::isfinite(power); });
}

Figure range_doppler_figure(const RadarMap& map, const std::string& when) {
  const std::string name = "range_doppler";
  return {name,
          "Range-Doppler map" + when,
          {{name + ".csv", map_table(map, "speed_m_s", "range_m")}},
          map_commands(name, map.power_dbm, "range (m)", "speed, coming nearer (m/s)", 2, 1)};
}

Figure micro_doppler_figure(const RadarMap& spectra, const std::string& of) {
  const std::string name = "micro_doppler";
  return {name,
          "Doppler spectra" + of,
          {{name + ".csv", map_table(spectra, "time_s", "speed_m_s")}},
          map_commands(name, spectra.power_dbm, "time (s)", "speed, coming nearer (m/s)", 1, 2)};
}

}  // namespace wavetracer::plots
