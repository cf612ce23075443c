// SPDX-License-Identifier: Apache-2.0
// The results of a calibration as text, tables, a figure and a page.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "calibration/calibration.hpp"
#include "plots/figure.hpp"
#include "study/text.hpp"

namespace wavetracer::calibration {

// Parameters with their values before and after, standard errors, and what the data tell of them.
study::NumberTable parameter_table(const Calibration& result);
// Offset, deviation and rank correlation of each group of points: as it is, fitted, and held out.
study::NumberTable agreement_table(const Calibration& result);
// Sentences about what the data do not tell.
std::vector<std::string> findings(const Calibration& result);

std::string calibration_text(const Calibration& result);
// calibration.csv: a row for each point. Levels are gains in dB; computed ones contain the offset.
std::string points_csv(const Calibration& result);
std::string parameters_csv(const Calibration& result);
// Measured against computed levels, and a map of what is left.
plots::Figure calibration_figure(const Calibration& result);

struct Written {
  std::vector<std::filesystem::path> files;
  std::string problem;  // the reason if there is no plot, else empty
};
// Writes calibration.csv with its plot, parameters.csv, fitted.toml and calibration.html. Throws RuntimeError if a file
// cannot be written.
Written write_calibration(const Calibration& result, const std::string& command_line,
                          const std::filesystem::path& folder);

}  // namespace wavetracer::calibration
