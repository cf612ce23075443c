// SPDX-License-Identifier: Apache-2.0
// Messages for a command line that CLI11 refuses, and `wavetracer help`.
#pragma once
#include <CLI/App.hpp>
#include <string>

namespace wavetracer::app {

// Returns one line: the command, what is wrong with which word, the nearest known word, and where to find help.
std::string usage_problem(const CLI::App& program, const CLI::ParseError& error);

// Makes every option refuse an empty value, which a script passes whose variable is not set; and every option that
// takes numbers those that are not finite: "nan" is within all ranges of CLI11.
void refuse_bad_values(CLI::App& program);

}  // namespace wavetracer::app
