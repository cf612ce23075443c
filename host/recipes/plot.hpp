// The plot of a figure: a gnuplot script that reads the table, and gnuplot to run it.
// The script names files of its own folder only, so that the folder can be moved and the script run again.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>
#include "recipes/series.hpp"

namespace wavetracer::recipes {

// Eight colours that stay apart for colour-blind readers: M. Okabe, K. Ito, "Color Universal Design", 2008, but for its
// yellow, which is too pale for a line on white.
constexpr std::array<std::string_view, 8> colours = {"#000000", "#e69f00", "#56b4e9", "#009e73",
                                                     "#999999", "#0072b2", "#d55e00", "#cc79a7"};

// As gnuplot writes a quote within single quotes.
std::string quoted(const std::string& text);

// Draws NAME.csv into NAME.svg: one panel without and one with the time of ordering, each a line a series.
std::string plot_script(const std::string& name, const std::string& title, const std::vector<Series>& series);

// Runs the script in its folder. Returns an empty text, or one line that says why there is no plot and what to do.
std::string run_gnuplot(const std::filesystem::path& folder, const std::string& script);

}  // namespace wavetracer::recipes
