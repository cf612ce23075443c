// SPDX-License-Identifier: Apache-2.0
// Splits chunks of a file into lines, and lines into cells.
#include "motion/text_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "motion/input_text.hpp"

namespace wavetracer {

void TextLines::fail(std::string_view what) const { fail_at(file(), number_, what); }

bool TextLines::next() {
  constexpr size_t longest = 1 << 20;
  line_.clear();
  bool found = false;
  while (!found) {
    if (rest_.empty()) rest_ = stream_.next();
    if (rest_.empty()) break;
    const size_t end = rest_.find('\n');
    found = end != rest_.npos;
    line_ += rest_.substr(0, end);
    rest_.remove_prefix(found ? end + 1 : rest_.size());
    if (line_.size() > longest) fail_at(file(), number_ + 1, "the line does not end; this is no file of trajectories");
  }
  if (!found && line_.empty()) return false;
  if (++number_ == 1 && line_.starts_with("\xEF\xBB\xBF")) line_.erase(0, 3);  // byte order mark of UTF-8
  if (line_.ends_with('\r')) line_.pop_back();
  return true;
}

bool CsvRows::next() {
  while (lines_.next()) {
    text_ = separator_ == '\t' ? lines_.line() : trimmed(lines_.line());  // the first and last cells may be empty
    if (trimmed(text_).empty() || text_.front() == '#') continue;
    split(text_);
    return true;
  }
  return false;
}

// Splits a line into cells_, with quotes removed.
void CsvRows::split(std::string_view line) {
  cells_.clear();
  size_t at = 0;
  do {
    std::string& cell = cells_.emplace_back();
    const size_t start = std::min(line.find_first_not_of(" \t", at), line.size());
    if (start < line.size() && line[start] == '"') {
      at = quoted(line, start + 1, cell);
    } else {
      const size_t end = std::min(line.find(separator_, at), line.size());
      cell = trimmed(line.substr(at, end - at));
      at = end;
    }
  } while (at++ < line.size());
}

// Reads a quoted cell whose text begins at `at`; returns the place of the separator after it, or the end of the line.
size_t CsvRows::quoted(std::string_view line, size_t at, std::string& cell) const {
  for (;; ++at) {
    const size_t quote = line.find('"', at);
    if (quote == line.npos) fail(fmt::format("column {}: the quotes are not closed", cells_.size()));
    cell += line.substr(at, quote - at);
    at = quote + 1;
    if (at == line.size() || line[at] != '"') break;
    cell += '"';  // "" is a quote inside of quotes
  }
  const size_t end = std::min(line.find_first_not_of(" \t", at), line.size());
  if (end < line.size() && line[end] != separator_)
    fail(fmt::format("column {}: text after the quotes", cells_.size()));
  return end;
}

}  // namespace wavetracer
