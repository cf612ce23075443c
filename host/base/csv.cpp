// SPDX-License-Identifier: Apache-2.0
// Cells are added with a comma behind each; the last comma of a row becomes its line end.
#include "base/csv.hpp"
#include <fmt/ranges.h>
#include <stdexcept>

namespace wavetracer {

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

Csv::Csv(std::vector<std::string> names)
    : names_(std::move(names)), text_(fmt::format("{}\n", fmt::join(names_, ","))) {}

void Csv::add_texts(const std::vector<std::string>& cells) {
  check(cells.size());
  for (const std::string& cell : cells) add_cell(cell);
  text_.back() = '\n';
}

void Csv::check(size_t cells) const {
  if (cells != names_.size())
    throw std::logic_error(fmt::format("a row has {} cells, and its table {} columns", cells, names_.size()));
}

}  // namespace wavetracer
