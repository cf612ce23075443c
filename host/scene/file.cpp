// Whole files in and out of memory.
// Assumes that a scene file fits into memory; sizes are taken from the file system, never from file content.
#include "scene/file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "files/input_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

std::string read_file(const std::filesystem::path& path) {
  check_input_file(path, "the file", uint64_t{4} << 30);  // bytes; parsers take several times as much
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
  std::string content((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read to its end", path.string()));
  return content;
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  const std::filesystem::path temporary = path.string() + ".tmp";
  std::error_code ignored;
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out) {
      const std::string reason = std::strerror(errno);
      std::filesystem::remove(temporary, ignored);
      throw RuntimeError(fmt::format("{}: cannot be written: {}", path.string(), reason));
    }
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) {
    std::filesystem::remove(temporary, ignored);
    throw RuntimeError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
  }
}

}  // namespace wavetracer
