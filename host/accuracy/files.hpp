// What a study leaves in its folder: accuracy.csv, the plot with its script, and a page.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "accuracy/study.hpp"
#include "plots/figure.hpp"

namespace wavetracer::accuracy {

// Time a frame against lost power and lost paths. At least one row is measured.
plots::Figure front_figure(const Study& study);

// A page without links to anything outside of it; svg: the plot, or empty.
std::string page_html(const Study& study, const std::string& command_line, const std::string& svg);

struct Written {
  std::vector<std::filesystem::path> files;
  std::string problem;  // why there is no plot; else empty
};

// Throws RuntimeError where a file cannot be written.
Written write_files(const Study& study, const std::string& command_line, const std::filesystem::path& folder);

}  // namespace wavetracer::accuracy
