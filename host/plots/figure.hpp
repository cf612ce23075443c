// SPDX-License-Identifier: Apache-2.0
// A figure: its data as CSV, a gnuplot script that draws them, and the picture, side by side in one folder.
// The script reads only the data beside it, so a user can change it and run it again.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer::plots {

// Chooses the terminal that draws, and the suffix of the picture's file.
enum class Format { svg, png, pdf };

struct DataFile {
  std::string name;  // name of the file, which begins with that of the figure
  std::string text;  // CSV with one header row, or words about the figure
};

struct Figure {
  std::string name;   // name of its files, without suffix
  std::string title;  // one line
  std::vector<DataFile> data;
  std::string commands;  // gnuplot commands that follow those of terminal, title and style
  double width_px = 900, height_px = 520;
};

struct Drawn {
  std::vector<std::filesystem::path> files;
  std::string problem;  // if there is no picture, the reason and what to do; else empty
};

// The colours of numbers (base/colours.hpp), from bright and small to dark and large, so that the largest are never
// pale on white, as on the light page of the viewer. Maps, which fill their area, have them the other way round.
std::string palette();

// Returns the commands of a colour range that covers these decibels, in steps of 5 dB; values weaker than the largest
// by more than `span_db` all get the brightest colour. Values that are not finite are ignored; at least one must be
// finite.
std::string colour_range(const std::vector<double>& values_db, double span_db);

// Returns commands that name 1, 2 and 5 times the powers of ten on a logarithmic axis ("x", "y") of less than two
// decades, which would have one label or none. low, high: its ends, numbers or expressions of gnuplot.
std::string log_tics(const std::string& axis, const std::string& low, const std::string& high);

// Writes data and script, all or none, and draws. The script draws the first of the formats, at least one. Throws
// RuntimeError if a file cannot be written.
Drawn draw(const Figure& figure, const std::vector<Format>& formats, const std::filesystem::path& folder);
inline Drawn draw(const Figure& figure, Format format, const std::filesystem::path& folder) {
  return draw(figure, std::vector<Format>{format}, folder);
}

}  // namespace wavetracer::plots
