// SPDX-License-Identifier: Apache-2.0
// Reads columns of numbers of a CSV file by RFC 4180, found by their names in the header row.
// The text comes in pieces of any size, so memory grows with the rows and not with the file.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

class CsvColumns {
 public:
  explicit CsvColumns(const std::vector<std::string>& names);
  void read(std::string_view piece);
  // Must be called after the last piece.
  void finish();
  // For the column names[i]: whether it exists, and a value per row, NaN if the field is empty, missing or no number.
  bool has(size_t i) const { return columns_[i].field != no_field; }
  const std::vector<double>& values(size_t i) const { return columns_[i].values; }

 private:
  // Longest: number of characters of a name or a number that are kept.
  static constexpr size_t no_field = ~size_t{0}, longest = 64;
  struct Column {
    std::string name;
    size_t field = no_field;
    std::vector<double> values = {};
  };
  void end_field();
  void end_row();

  std::vector<Column> columns_;
  std::string text_;
  size_t field_ = 0, rows_ = 0;
  bool header_ = true, quoted_ = false, begun_ = false;
};

}  // namespace wavetracer
