// A quote begins or ends a quoted part, wherever it stands: within one, commas and line ends are text.
// A doubled quote ends a part and begins the next, so it needs no rule of its own where its text does not matter.
#include "results/csv_column.hpp"
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

void CsvColumn::end_field() {
  if (header_ && wanted_ == no_field && text_ == name_) wanted_ = field_;
  if (!header_ && field_ == wanted_) values_.push_back(number_of(text_));
  text_.clear();
  ++field_;
}

void CsvColumn::end_row() {
  end_field();
  if (!header_ && wanted_ != no_field && field_ <= wanted_) values_.push_back(number_of(""));
  header_ = begun_ = false;
  field_ = 0;
}

void CsvColumn::read(std::string_view piece) {
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
    else if (c != '\r' && text_.size() <= longest && (header_ || field_ == wanted_))
      text_ += c;
  }
}

bool CsvColumn::finish() {
  if (begun_) end_row();
  return wanted_ != no_field;
}

}  // namespace wavetracer
