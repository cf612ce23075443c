// A new folder below the system's temporary one, removed with all that is in it.
// For benchmarks that start the program.
#pragma once
#include <fmt/format.h>
#include <stdlib.h>
#include <filesystem>
#include <string>
#include "wavetracer/error.hpp"

namespace wavetracer::bench {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "wavetracer-bench-XXXXXX").string();
    if (!mkdtemp(name.data())) throw RuntimeError(fmt::format("cannot make a folder {}: is TMPDIR writable?", name));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string operator/(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace wavetracer::bench
