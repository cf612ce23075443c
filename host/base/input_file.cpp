// SPDX-License-Identifier: Apache-2.0
// The file's status is read without opening it: opening a pipe would wait for its writer.
#include "base/input_file.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

const char* kind_of(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::fifo:
      return "a pipe";
    case std::filesystem::file_type::socket:
      return "a socket";
    case std::filesystem::file_type::character:
    case std::filesystem::file_type::block:
      return "a device";
    default:
      return "no plain file";
  }
}

// The folder that a relative path was looked for in.
std::string place_of(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error).lexically_normal();
  if (path.is_absolute() || error) return "";
  return fmt::format("; it was looked for in {}", whole.parent_path().string());
}

}  // namespace

std::string backslash_hint(const std::filesystem::path& path) {
  // TOML reads the "\t" of a folder "\town" as a tab; four other letters have the same problem.
  constexpr std::string_view coded = "\\\t\b\n\f\r", letters = "\\tbnfr";
  std::string text;
  for (const char c : path.string()) {
    const size_t at = coded.find(c);
    text += at == coded.npos ? std::string(1, c) : at == 0 ? "/" : std::string{'/', letters[at]};
  }
  if (text == path.string()) return "";
  std::error_code unnameable;
  const bool there = std::filesystem::exists(text, unnameable);
  return fmt::format("; {}write / instead of \\ between the names of folders",
                     there ? fmt::format("did you mean '{}'? ", text) : "");
}

std::string input_file_problem(const std::filesystem::path& path, const char* what, uint64_t most_bytes) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return "no such file" + place_of(path) + backslash_hint(path);
  if (status.type() == fs::file_type::none) return fmt::format("cannot be opened: {}", error.message());
  if (fs::is_directory(status)) return fmt::format("is a folder; name {} inside it", what);
  if (!fs::is_regular_file(status))
    return fmt::format("is {}; {} must be a plain file: write its content to one", kind_of(status.type()), what);
  const uint64_t bytes = fs::file_size(path, error);
  if (!error && bytes > most_bytes)
    return fmt::format("has {} bytes, and {} may have {}: is it a file of another kind?", bytes, what, most_bytes);
  return "";
}

void check_input_file(const std::filesystem::path& path, const char* what, uint64_t most_bytes) {
  if (const std::string problem = input_file_problem(path, what, most_bytes); !problem.empty())
    throw InputError(fmt::format("{}: {}", path.string(), problem));
}

}  // namespace wavetracer
