// A file as a sequence of chunks, plain or gzip: the content decides, never the name.
// Holds one chunk at a time, so that files of gigabytes can be read.
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
  // what: the kind of file, for messages. Throws InputError when the file is missing, no plain file, or unreadable.
  explicit ByteStream(const std::filesystem::path& path, const char* what = "trajectory file");
  ~ByteStream();

  const std::string& file() const { return file_; }
  // The next chunk, which stays for the following call of next(). Empty at the end.
  std::string_view peek();
  // The next chunk, valid until the next call. Empty at the end. Throws InputError where a gzip stream is damaged, or
  // holds far more than such files do.
  std::string_view next();

 private:
  struct Handle;
  std::string file_;
  const char* what_;
  std::unique_ptr<Handle> handle_;
  std::string chunk_;
  uint64_t bytes_ = 0, most_bytes_ = 0;  // unpacked so far, and the limit
  size_t size_ = 0;                      // bytes of chunk_ in use
  bool peeked_ = false;                  // the chunk has not been given out by next() yet
};

}  // namespace wavetracer
