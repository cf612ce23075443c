// One column of numbers of a CSV file by RFC 4180, found by its name in the header row.
// The text comes in pieces of any size, so memory grows with the rows and not with the file.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

class CsvColumn {
 public:
  explicit CsvColumn(std::string name) : name_(std::move(name)) {}
  void read(std::string_view piece);
  // After the last piece: whether there is such a column.
  bool finish();
  // A value per row, NaN where the field is empty, missing or no number.
  const std::vector<double>& values() const { return values_; }

 private:
  static constexpr size_t no_field = ~size_t{0}, longest = 64;  // characters of a name or a number that are kept
  void end_field();
  void end_row();

  std::string name_, text_;
  size_t field_ = 0, wanted_ = no_field;
  bool header_ = true, quoted_ = false, begun_ = false;
  std::vector<double> values_;
};

}  // namespace wavetracer
