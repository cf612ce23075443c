// SPDX-License-Identifier: Apache-2.0
// Writes the files of a study: accuracy.csv, the plot with its script, and a page.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "accuracy/study.hpp"
#include "plots/figure.hpp"

namespace wavetracer::accuracy {

// Plots the time of a frame against lost power and lost paths. At least one row must be measured.
plots::Figure front_figure(const Study& study);

// Returns a page without links to anything outside of it. svg: the plot, or empty.
std::string page_html(const Study& study, const std::string& command_line, const std::string& svg);

struct Written {
  std::vector<std::filesystem::path> files;
  std::string problem;  // the reason if there is no plot, else empty
};

// Throws RuntimeError if a file cannot be written.
Written write_files(const Study& study, const std::string& command_line, const std::filesystem::path& folder);

}  // namespace wavetracer::accuracy
