// SPDX-License-Identifier: Apache-2.0
// Reads a text file line by line, and the cells of rows whose values are separated by commas, or by another character.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "motion/byte_stream.hpp"

namespace wavetracer {

// Lines end with LF or CRLF; a byte order mark is skipped. A line of more than a megabyte is an error: such a file is
// no table.
class TextLines {
 public:
  explicit TextLines(ByteStream& stream) : stream_(stream) {}

  // Reads the next line; returns false at the end of the file.
  bool next();
  // Returns the line without its end.
  const std::string& line() const { return line_; }
  uint64_t number() const { return number_; }  // counted from 1
  const std::string& file() const { return stream_.file(); }
  // Throws InputError with file and line.
  [[noreturn]] void fail(std::string_view what) const;

 private:
  ByteStream& stream_;
  std::string_view rest_;  // unread part of the chunk
  std::string line_;
  uint64_t number_ = 0;
};

// Blank lines and comments are skipped. The format is RFC 4180 without line breaks in quotes.
class CsvRows {
 public:
  explicit CsvRows(ByteStream& stream, char separator = ',') : lines_(stream), separator_(separator) {}

  // Reads the next row; returns false at the end of the file.
  bool next();
  // The current row: its cells without surrounding blanks and quotes, the line number, counted from 1, and the text.
  const std::vector<std::string>& cells() const { return cells_; }
  uint64_t number() const { return lines_.number(); }
  std::string_view text() const { return text_; }
  const std::string& file() const { return lines_.file(); }
  // Throws InputError with file and line.
  [[noreturn]] void fail(std::string_view what) const { lines_.fail(what); }

 private:
  void split(std::string_view line);
  size_t quoted(std::string_view line, size_t at, std::string& cell) const;

  TextLines lines_;
  char separator_;
  std::string text_;
  std::vector<std::string> cells_;
};

}  // namespace wavetracer
