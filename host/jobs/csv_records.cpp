// SPDX-License-Identifier: Apache-2.0
// Lines without a quote, which are nearly all, are split by memchr.
#include "jobs/csv_records.hpp"
#include <algorithm>

namespace wavetracer {
namespace {

constexpr size_t block_bytes = size_t{4} << 20;

// Returns the place after the last line end outside of quotes; 0 if there is none. The text begins with a record, so an
// even number of quotes lies before such a line end.
size_t end_of_records(std::string_view text) {
  auto before = std::ranges::count(text, '"');
  size_t end = text.size();
  for (size_t line = text.rfind('\n'); line != std::string_view::npos; line = text.substr(0, line).rfind('\n')) {
    before -= std::ranges::count(text.substr(line, end - line), '"');
    end = line;
    if (before % 2 == 0) return line + 1;
  }
  return 0;
}

std::string& field(std::vector<std::string>& fields, size_t index) {
  if (index == fields.size()) fields.emplace_back();
  fields[index].clear();
  return fields[index];
}

// Reads the record at the beginning of a text with quotes; returns its length, and the number of its fields.
size_t take_quoted(std::string_view text, std::vector<std::string>& fields, size_t& count) {
  std::string* to = &field(fields, count++);
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      *to += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      to = &field(fields, count++);
    else if (c == '\n' && !quoted)
      return i + 1;
    else
      *to += c;
  }
  return text.size();
}

}  // namespace

bool CsvBlocks::next(std::string& block) {
  block = std::move(rest_);
  rest_.clear();
  for (;;) {
    const size_t before = block.size();
    block.resize(before + block_bytes);
    file_.read(block.data() + before, static_cast<std::streamsize>(block_bytes));
    block.resize(before + static_cast<size_t>(file_.gcount()));
    if (block.size() < before + block_bytes) return !block.empty();
    if (const size_t end = end_of_records(block); end > 0) {
      rest_ = block.substr(end);
      block.resize(end);
      return true;
    }
  }
}

bool take_record(std::string_view& text, std::vector<std::string>& fields) {
  if (text.empty()) return false;
  const size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  size_t count = 0;
  if (line.find('"') != std::string_view::npos) {
    text.remove_prefix(take_quoted(text, fields, count));
  } else {
    for (size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
      field(fields, count++) = line.substr(0, comma);
      line.remove_prefix(comma + 1);
    }
    field(fields, count++) = line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  fields.resize(count);
  return true;
}

}  // namespace wavetracer
