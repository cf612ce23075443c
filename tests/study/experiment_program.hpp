// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of `wavetracer thesis`: a street for its config file, its tables, its errors.
#pragma once
#include <doctest/doctest.h>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>
#include "app/program.hpp"

namespace experiment_program {

inline const std::string street =
    "scene.generate = \"--blocks 2\"\ntrace.max_depth = 2\n"
    "[[transmitter]]\nname = \"mast\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"car\"\nposition_m = [50, 0, 2]\n";

// The lines of a table as cells by column.
inline std::vector<std::map<std::string, std::string>> table(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::string> columns;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::vector<std::string> words;
    for (std::string word; std::getline(cells, word, ',');) words.push_back(word);
    if (columns.empty()) {
      columns = words;
      continue;
    }
    REQUIRE(words.size() == columns.size());
    rows.emplace_back();
    for (size_t i = 0; i < words.size(); ++i) rows.back()[columns[i]] = words[i];
  }
  return rows;
}

inline double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

// Exit code, a part of the message, nothing on stdout.
inline void check_error(const std::vector<std::string>& words, int code, const std::string& message) {
  const Outcome outcome = run_program(words);
  CAPTURE(outcome.err);
  CHECK(outcome.code == code);
  CHECK(contains(outcome.err, message));
  CHECK(outcome.out.empty());
}

}  // namespace experiment_program
