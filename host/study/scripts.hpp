// SPDX-License-Identifier: Apache-2.0
// The plots of experiments: figures whose script NAME.gp draws NAME.csv into NAME.svg.
// They need no device. All functions throw std::logic_error for a column that the table lacks.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include "base/csv.hpp"
#include "plots/figure.hpp"
#include "plots/gnuplot.hpp"
#include "study/series.hpp"

namespace wavetracer::study {

using plots::colours;
using plots::quoted;

// Returns the index of a column, from 1 as gnuplot counts.
size_t column_of(const std::vector<std::string>& columns, const std::string& name);
// Returns the figure of one table; the title stands over all panels, in the commands.
plots::Figure experiment_figure(const std::string& name, const Csv& table, const std::string& commands, double width_px,
                                double height_px);

// Plots figures of orders: one panel without and one with the time of ordering, each with a line per series, in
// nanoseconds a ray and below in seconds.
plots::Figure order_figure(const std::string& name, const std::string& title, const std::vector<Series>& series,
                           const Csv& table);

// Panels with a line per setting, or its points, of tables in which every row has a drive and a setting; or other
// columns in place of these two.
struct LinePanel {
  std::string title, y, y_label;  // y: a column
  std::string drive;              // only rows of this drive, or of this value of `panel_column`; empty: all
  bool log_y = false;
  // Values below this count as nothing: a logarithmic axis begins there; a linear one begins at 0 and ends no lower. 0:
  // any range.
  double least = 0;
};

struct LinePlot {
  std::string name{}, title{};  // name: of the files NAME.csv and NAME.svg; title: of the plot
  std::vector<std::string> settings{};
  std::string line_column = "setting", panel_column = "drive";  // they say to which line and panel a row belongs
  std::string x{}, x_label{};
  bool log_x = false;
  bool x_in_thousands = false;        // numbers along the axis are "50k"
  std::optional<double> least_x{};    // smaller values are drawn here
  bool points = false;                // without lines, but for those of `joined`
  std::vector<std::string> joined{};  // settings
  double point_size = 0.6;
  uint64_t only_rays = 0;  // only rows of this number of rays; 0: all
  uint32_t panels_a_row = 2;
  std::vector<LinePanel> panels{};
};

plots::Figure line_figure(const LinePlot& plot, const Csv& table);

// Panels with a line per depth, of tables with a column `depth`.
struct DepthPanel {
  std::string title;
  std::string x, y;          // columns
  std::string only, equals;  // only rows whose column `only` has the text `equals`
};

struct DepthPlot {
  std::string name, title;
  uint32_t max_depth = 0;
  std::string x_label;
  bool log_x = false;
  bool points = false;  // without lines, for values that jump from row to row
  uint32_t panels_a_row = 1;
  std::vector<DepthPanel> panels{};
};

plots::Figure depth_figure(const DepthPlot& plot, const Csv& table);

}  // namespace wavetracer::study
