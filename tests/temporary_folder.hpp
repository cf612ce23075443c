// A folder for small input files that goes away with the test.
// Below the system's temporary folder, under a name that nobody else has.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace wavetracer::test {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int count = 0;
    do {
      path_ = std::filesystem::temp_directory_path() / ("wavetracer_test_" + std::to_string(++count));
    } while (!std::filesystem::create_directory(path_));
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

 private:
  std::filesystem::path path_;
};

}  // namespace wavetracer::test
