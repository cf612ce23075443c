// SPDX-License-Identifier: Apache-2.0
// Reads whole files into memory and writes them. It assumes that a scene file fits into memory; sizes are taken from
// the file system, never from file content.
#include "base/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <span>
#include <utility>

#include "base/input_file.hpp"
#include "base/pending_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why, const std::string& what_to_do) {
  throw RuntimeError(fmt::format("cannot read {}: {}; {}", file.string(), why, what_to_do));
}

}  // namespace

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

// It uses plain POSIX calls: for a folder, a C++ stream would throw an error that users do not understand.
std::optional<std::string> read_text_if_there(const std::filesystem::path& file, uint64_t most_bytes,
                                              const std::string& what_to_do) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0 && errno == ENOENT) return std::nullopt;
  if (descriptor < 0) fail(file, std::strerror(errno), what_to_do);
  std::string text, block(size_t{1} << 16, '\0');
  ssize_t got = 0;
  int error = 0;
  do {
    got = ::read(descriptor, block.data(), block.size());
    error = got < 0 ? errno : 0;
    if (got > 0) text.append(block, 0, static_cast<size_t>(got));
  } while ((got > 0 && text.size() <= most_bytes) || error == EINTR);
  ::close(descriptor);
  if (error != 0) fail(file, std::strerror(error), what_to_do);
  if (text.size() > most_bytes) fail(file, "it is too large for what it should be", what_to_do);
  return text;
}

std::string read_text(const std::filesystem::path& file, uint64_t most_bytes, const std::string& what_to_do) {
  std::optional<std::string> text = read_text_if_there(file, most_bytes, what_to_do);
  if (!text) fail(file, std::strerror(ENOENT), what_to_do);
  return *std::move(text);
}

}  // namespace wavetracer
