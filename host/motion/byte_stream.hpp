// SPDX-License-Identifier: Apache-2.0
// A file as a sequence of chunks, plain or gzip, recognised by content and not by name.
// It holds one chunk at a time, so that files of gigabytes can be read.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace wavetracer {

class ByteStream {
 public:
  // what: the kind of file, for messages. Throws InputError if the file is missing, is no plain file, or is unreadable.
  explicit ByteStream(const std::filesystem::path& path, const char* what = "trajectory file");
  ~ByteStream();

  const std::string& file() const { return file_; }
  // Returns the next chunk, which next() will return again; empty at the end.
  std::string_view peek();
  // Returns the next chunk, valid until the next call; empty at the end. Throws InputError if a gzip stream is damaged,
  // or unpacks to far more than such files do.
  std::string_view next();

 private:
  struct Handle;
  std::string file_;
  const char* what_;
  std::unique_ptr<Handle> handle_;
  std::string chunk_;
  uint64_t bytes_ = 0, most_bytes_ = 0;  // bytes unpacked so far, and the limit
  size_t size_ = 0;                      // bytes of chunk_ in use
  bool peeked_ = false;                  // next() has not returned the chunk yet
};

}  // namespace wavetracer
