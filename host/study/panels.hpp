// SPDX-License-Identifier: Apache-2.0
// The layout of plots on a page of 800 pixels: two panels a row at most, and no more lines in a panel than there are
// colours. Plots with more lines have several blocks of panels, each with a key below it.
#pragma once
#include <cstddef>
#include <string>
#include <vector>
#include "plots/gnuplot.hpp"

namespace wavetracer::study {

constexpr double page_width_px = 800;
constexpr size_t most_lines = plots::colours.size();

// Divides settings into blocks of at most most_lines: those "printed" apart from others, and equal shares of what is
// too much. The first setting, which the others are compared with, is in every block if it is no cache.
std::vector<std::vector<std::string>> line_blocks(const std::vector<std::string>& settings);

// Blocks of panels from top to bottom.
class PanelPage {
 public:
  // lines: the number of lines of each block; every block has `panels` panels, of which `a_row` are in a row.
  PanelPage(const std::vector<size_t>& lines, size_t panels, size_t a_row);

  double height_px() const { return height_px_; }
  // Returns gnuplot commands that set the margins of a panel, which must come before its plot.
  std::string margins(size_t block, size_t panel) const;
  // Returns the command that puts the key of the block's last panel below the block.
  std::string key(size_t block) const;

 private:
  size_t columns_, rows_;
  std::vector<size_t> key_rows_ = {};
  std::vector<double> tops_px_ = {}, keys_px_ = {};  // from the top of the page
  double height_px_ = 0;
};

}  // namespace wavetracer::study
