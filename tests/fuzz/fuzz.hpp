// SPDX-License-Identifier: Apache-2.0
// Every fuzz target includes this: the input as a file in memory, and the errors that are valid answers.
// A target ends with a crash for anything else: another exception, a fault, a leak, too much memory or time.
#pragma once
#include <fcntl.h>
#include <unistd.h>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include "wavetracer/error.hpp"

namespace wavetracer::fuzz {

// A file in memory, rewritten for each input, alone in a folder that is removed with it.
class MemoryFile {
 public:
  // name: for readers that look at it, such as "input.obj".
  explicit MemoryFile(const std::string& name = "input")
      : path_("/dev/shm/wavetracer-fuzz-" + std::to_string(getpid()) + "/" + name) {
    std::filesystem::create_directories(path_.parent_path());
    descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
    if (descriptor_ < 0) std::abort();
  }
  ~MemoryFile() {
    close(descriptor_);
    std::filesystem::remove_all(path_.parent_path());
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& write(std::string_view data) {
    if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, data.data(), data.size(), 0) != std::ssize(data))
      std::abort();
    return path_;
  }
  const std::filesystem::path& write(const uint8_t* data, size_t size) {
    return write({reinterpret_cast<const char*>(data), size});
  }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
};

inline std::string_view text_of(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Runs the reader; a refusal by one of our Errors is as good as a result.
template <typename Reader>
int accept_or_refuse(const Reader& reader) {
  try {
    reader();
  } catch (const Error&) {
  }
  return 0;
}

}  // namespace wavetracer::fuzz
