// The plot of a figure: a gnuplot script that reads the table, and gnuplot to run it.
// The script names files of its own folder only, so that the folder can be moved and the script run again.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "recipes/series.hpp"

namespace wavetracer::recipes {

// Draws NAME.csv into NAME.svg: one panel without and one with the time of ordering, each a line a series.
std::string plot_script(const std::string& name, const std::string& title, const std::vector<Series>& series);

// Runs the script in its folder. Returns an empty text, or one line that says why there is no plot and what to do.
std::string run_gnuplot(const std::filesystem::path& folder, const std::string& script);

}  // namespace wavetracer::recipes
