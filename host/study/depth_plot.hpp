// Plots of tables with a column `depth`: panels side by side and one below the other, each with a line a depth.
// Needs no device; run_gnuplot (plot.hpp) draws.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace wavetracer::study {

struct DepthPanel {
  std::string title;
  std::string x, y;          // columns
  std::string only, equals;  // rows whose column `only` has the text `equals`
};

struct DepthPlot {
  std::string name, title;           // of the files NAME.csv and NAME.svg; of the plot
  std::vector<std::string> columns;  // of the table, in order
  uint32_t max_depth = 0;
  std::string x_label, y_label;
  bool log_x = false;
  bool points = false;  // without lines, where values jump from row to row
  uint32_t panels_a_row = 1;
  std::vector<DepthPanel> panels;
};

// The script NAME.gp. Throws std::logic_error for a column that the table has not.
std::string depth_plot_script(const DepthPlot& plot);

}  // namespace wavetracer::study
