// SPDX-License-Identifier: Apache-2.0
// A quote begins or ends a quoted part, wherever it stands: within one, commas and line ends are text.
// A doubled quote ends a part and begins the next, so it needs no special rule where its text does not matter.
#include "results/csv_columns.hpp"
#include <charconv>
#include <limits>

namespace wavetracer {
namespace {

double number_of(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [after, problem] = std::from_chars(text.data(), end, value);
  return problem == std::errc{} && after == end ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

CsvColumns::CsvColumns(const std::vector<std::string>& names) {
  for (const std::string& name : names) columns_.push_back({name});
}

void CsvColumns::end_field() {
  if (header_ && field_ == 0 && text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);  // skips a byte order mark
  for (Column& column : columns_) {
    if (header_ && column.field == no_field && text_ == column.name) column.field = field_;
    if (!header_ && field_ == column.field) column.values.push_back(number_of(text_));
  }
  text_.clear();
  ++field_;
}

void CsvColumns::end_row() {
  end_field();
  if (!header_) ++rows_;
  for (Column& column : columns_)
    if (column.field != no_field) column.values.resize(rows_, number_of(""));  // for a row that ends before this field
  header_ = begun_ = false;
  field_ = 0;
}

void CsvColumns::read(std::string_view piece) {
  for (const char c : piece) {
    if (c == '\n' && !quoted_) {
      end_row();
      continue;
    }
    begun_ = true;
    if (c == '"')
      quoted_ = !quoted_;
    else if (c == ',' && !quoted_)
      end_field();
    else if (c != '\r' && text_.size() <= longest)
      text_ += c;
  }
}

void CsvColumns::finish() {
  if (begun_) end_row();
}

}  // namespace wavetracer
