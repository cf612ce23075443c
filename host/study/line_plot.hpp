// Plots of tables in which every row has a drive and a setting: panels with a line a setting, or its points.
// Needs no device; run_gnuplot (plot.hpp) draws.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace wavetracer::study {

struct LinePanel {
  std::string title, y, y_label;  // y: a column
  std::string drive;              // rows of this drive alone; empty: all
  bool log_y = false;
  // What counts as nothing: a logarithmic axis begins there, a linear one at 0 and ends no lower. 0: any range.
  double least = 0;
};

struct LinePlot {
  std::string name{}, title{};         // of the files NAME.csv and NAME.svg; of the plot
  std::vector<std::string> columns{};  // of the table, in order
  std::vector<std::string> settings{};
  std::string x{}, x_label{};
  bool log_x = false;
  std::optional<double> least_x{};  // where smaller values are drawn
  bool points = false;              // without lines
  uint64_t only_rays = 0;           // rows of this number of rays alone; 0: all
  bool depths = false;              // rows of depths alone, else rows of all depths (column depth is 0)
  uint32_t panels_a_row = 2;
  std::vector<LinePanel> panels{};
};

// The script NAME.gp. Throws std::logic_error for a column that the table has not.
std::string line_plot_script(const LinePlot& plot);

}  // namespace wavetracer::study
