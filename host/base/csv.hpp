// SPDX-License-Identifier: Apache-2.0
// Writes tables as comma-separated values by RFC 4180: one row of names, then a row for each thing.
// Lines end with "\n" alone, as in all files of this program.
#pragma once
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace wavetracer {

// Returns the text as a field: within quotes if it contains a comma, a quote or a line end.
std::string csv_field(std::string_view text);

class Csv {
 public:
  Csv() = default;  // has no columns
  explicit Csv(std::vector<std::string> names);

  // Adds a row with a cell for each column. Texts become fields; doubles have as many digits as they need to read back
  // the same ("nan" if they are no number), truth values are 1 and 0. Throws std::logic_error for another number of
  // cells.
  template <class... Cells>
  void add(const Cells&... cells) {
    check(sizeof...(Cells));
    (add_cell(cells), ...);
    text_.back() = '\n';
  }
  // Adds a row of cells that are texts.
  void add_texts(const std::vector<std::string>& cells);

  const std::vector<std::string>& names() const { return names_; }
  const std::string& text() const { return text_; }

 private:
  std::vector<std::string> names_;
  std::string text_;

  void check(size_t cells) const;
  template <class Cell>
  void add_cell(const Cell& cell) {
    if constexpr (std::is_convertible_v<const Cell&, std::string_view>)
      text_ += csv_field(cell);
    else if constexpr (std::is_same_v<Cell, bool>)
      text_ += cell ? '1' : '0';
    else
      fmt::format_to(std::back_inserter(text_), "{}", cell);
    text_ += ',';
  }
};

}  // namespace wavetracer
