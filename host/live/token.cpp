// SPDX-License-Identifier: Apache-2.0
// Reads no more of the file than a token may have.
// It assumes POSIX permissions.
#include "live/token.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "wavetracer/error.hpp"

namespace wavetracer::live {

namespace {
constexpr size_t least_bytes = 16, most_bytes = 4096;
}

std::string read_token(const std::filesystem::path& file) {
  struct stat status;
  if (stat(file.c_str(), &status) != 0)
    throw InputError(fmt::format("--token-file {}: {}", file.string(), std::strerror(errno)));
  if (!S_ISREG(status.st_mode))
    throw InputError(fmt::format("--token-file {}: this is not a regular file", file.string()));
  if ((status.st_mode & 077) != 0)
    throw ConfigError(
        fmt::format("--token-file {0}: other users can read or write it; run: chmod 600 {0}", file.string()));
  std::ifstream in(file, std::ios::binary);
  std::string text(most_bytes + 2, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || (in.fail() && !in.eof()))
    throw InputError(fmt::format("--token-file {}: it cannot be read", file.string()));
  text.resize(static_cast<size_t>(in.gcount()));
  constexpr const char* white = " \t\r\n";
  const size_t first = text.find_first_not_of(white);
  text = first == text.npos ? "" : text.substr(first, text.find_last_not_of(white) + 1 - first);
  const bool plain = std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
  if (text.size() < least_bytes || text.size() > most_bytes || !plain)
    throw InputError(
        fmt::format("--token-file {}: a token must be one word of {} to {} letters, digits and signs; create one with: "
                    "openssl rand -hex 32",
                    file.string(), least_bytes, most_bytes));
  return text;
}

bool same_token(std::string_view secret, std::string_view shown) {
  unsigned difference = secret.size() == shown.size() ? 0 : 1;
  for (size_t i = 0; i < secret.size(); ++i) {
    const char other = shown.empty() ? '\0' : shown[i % shown.size()];
    difference |= static_cast<unsigned char>(secret[i] ^ other);
  }
  return *static_cast<volatile unsigned*>(&difference) == 0;
}

}  // namespace wavetracer::live
