// A file line by line: line ends LF or CRLF, a byte order mark is passed over.
// Assumes that no line is longer than a megabyte: such a file is something else.
#pragma once
#include <string>
#include <string_view>

#include "motion/byte_stream.hpp"

namespace wavetracer {

class TextLines {
 public:
  explicit TextLines(ByteStream& stream) : stream_(stream) {}

  // The next line; false at the end of the file.
  bool next();
  // Without its end.
  const std::string& line() const { return line_; }
  uint64_t number() const { return number_; }  // counted from 1
  const std::string& file() const { return stream_.file(); }
  // Throws InputError with file and line.
  [[noreturn]] void fail(std::string_view what) const;

 private:
  ByteStream& stream_;
  std::string_view rest_;  // of the chunk
  std::string line_;
  uint64_t number_ = 0;
};

}  // namespace wavetracer
