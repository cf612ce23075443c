// SPDX-License-Identifier: Apache-2.0
// Reads whole files into memory and writes them.
// It assumes that a scene file fits into memory; sizes are taken from the file system, never from file content.
#include "base/file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>

#include "base/input_file.hpp"
#include "base/pending_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

std::string read_file(const std::filesystem::path& path) {
  check_input_file(path, "the file", uint64_t{4} << 30);  // in bytes; parsers need several times as much memory
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
  std::string content((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read to its end", path.string()));
  return content;
}

void write_file(const std::filesystem::path& path, std::string_view content) {
  PendingFile(path, std::as_bytes(std::span(content))).commit();
}

}  // namespace wavetracer
