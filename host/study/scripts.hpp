// SPDX-License-Identifier: Apache-2.0
// The plots of experiments: gnuplot scripts NAME.gp that draw NAME.csv into NAME.svg.
// They only name files of their own folder, so that the folder can be moved and the script run again. They need no
// device. All functions throw std::logic_error for a column that the table lacks.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include "plots/gnuplot.hpp"
#include "study/series.hpp"

namespace wavetracer::study {

using plots::colours;
using plots::quoted;
using plots::run_gnuplot;

// Returns the index of a column, from 1 as gnuplot counts.
size_t column_of(const std::vector<std::string>& columns, const std::string& name);
// Returns the first lines of all scripts, for a drawing of this size in pixels.
std::string script_head(const std::string& name, size_t width, size_t height);
constexpr const char* script_grid = "set grid linecolor '#dddddd'\nset border 3\nset tics nomirror\n";

// Plots figures of orders: one panel without and one with the time of ordering, each with a line per series.
std::string order_script(const std::string& name, const std::string& title, const std::vector<Series>& series);

// Panels with a line per setting, or its points, of tables in which every row has a drive and a setting.
struct LinePanel {
  std::string title, y, y_label;  // y: a column
  std::string drive;              // only rows of this drive; empty: all
  bool log_y = false;
  // Values below this count as nothing: a logarithmic axis begins there; a linear one begins at 0 and ends no lower. 0:
  // any range.
  double least = 0;
};

struct LinePlot {
  std::string name{}, title{};         // name: of the files NAME.csv and NAME.svg; title: of the plot
  std::vector<std::string> columns{};  // columns of the table, in order
  std::vector<std::string> settings{};
  std::string x{}, x_label{};
  bool log_x = false;
  std::optional<double> least_x{};  // smaller values are drawn here
  bool points = false;              // without lines
  uint64_t only_rays = 0;           // only rows of this number of rays; 0: all
  bool depths = false;  // true: only rows of single depths; false: only rows of all depths (column depth is 0)
  uint32_t panels_a_row = 2;
  std::vector<LinePanel> panels{};
};

std::string line_script(const LinePlot& plot);

// Panels with a line per depth, of tables with a column `depth`.
struct DepthPanel {
  std::string title;
  std::string x, y;          // columns
  std::string only, equals;  // only rows whose column `only` has the text `equals`
};

struct DepthPlot {
  std::string name, title;
  std::vector<std::string> columns;
  uint32_t max_depth = 0;
  std::string x_label;
  bool log_x = false;
  bool points = false;  // without lines, for values that jump from row to row
  uint32_t panels_a_row = 1;
  std::vector<DepthPanel> panels{};
};

std::string depth_script(const DepthPlot& plot);

}  // namespace wavetracer::study
