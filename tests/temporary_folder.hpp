// SPDX-License-Identifier: Apache-2.0
// A folder for files of a test or a benchmark that goes away with it.
// Below the system's temporary folder, under a name that nobody else has.
#pragma once
#include <stdlib.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace wavetracer::test {

class TemporaryFolder {
 public:
  // Throws std::filesystem::filesystem_error where no folder can be made.
  TemporaryFolder() {
    const std::filesystem::path parent = std::filesystem::temp_directory_path();
    std::string name = (parent / "wavetracer_test_XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw std::filesystem::filesystem_error("no folder can be made in it: is TMPDIR writable?", parent,
                                              std::error_code(errno, std::generic_category()));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view content) const {
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace wavetracer::test
