// What is said of a command line that CLI11 refuses, and `wavetracer help`.
#pragma once
#include <CLI/App.hpp>
#include <string>

namespace wavetracer::app {

// One line: the command, what is wrong with which word, the nearest word that is known, and where help is.
std::string usage_problem(const CLI::App& program, const CLI::ParseError& error);

}  // namespace wavetracer::app
