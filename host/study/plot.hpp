// The plot of a figure: a gnuplot script that reads the table.
// It names files of its own folder only, so that the folder can be moved and the script run again.
#pragma once
#include <string>
#include <vector>
#include "plots/gnuplot.hpp"
#include "study/series.hpp"

namespace wavetracer::study {

using plots::colours;
using plots::quoted;
using plots::run_gnuplot;

// Draws NAME.csv into NAME.svg: one panel without and one with the time of ordering, each a line a series.
std::string plot_script(const std::string& name, const std::string& title, const std::vector<Series>& series);

}  // namespace wavetracer::study
