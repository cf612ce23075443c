// What is said of a command line that CLI11 refuses, and `wavetracer help`.
#pragma once
#include <CLI/App.hpp>
#include <string>

namespace wavetracer::app {

// One line: the command, what is wrong with which word, the nearest word that is known, and where help is.
std::string usage_problem(const CLI::App& program, const CLI::ParseError& error);

// Adds to every option that takes numbers that they are finite: "nan" is within all ranges of CLI11.
void refuse_non_finite(CLI::App& program);

}  // namespace wavetracer::app
