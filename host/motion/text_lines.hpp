// SPDX-License-Identifier: Apache-2.0
// Reads a file line by line: lines end with LF or CRLF, a byte order mark is skipped.
// A line of more than a megabyte is an error: such a file is no table.
#pragma once
#include <string>
#include <string_view>

#include "motion/byte_stream.hpp"

namespace wavetracer {

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

}  // namespace wavetracer
