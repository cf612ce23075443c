// SPDX-License-Identifier: Apache-2.0
// stat() follows links, including links in /proc, such as /dev/stdout, that do not lead to a file name.
// This is for Linux only.
#include "base/output_place.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstring>
#include "base/environment.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // the limit of Linux

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw RuntimeError(fmt::format("cannot write {}: {}; choose another name with -o", path.string(), why));
}

const char* words_for(mode_t mode) {
  if (S_ISDIR(mode)) return std::strerror(EISDIR);
  if (S_ISSOCK(mode)) return "it is a socket, which nothing can be written to by its name";
  if (S_ISBLK(mode)) return "it is a disk, which would be overwritten";
  return "it is neither a file nor a device";
}

// Returns a descriptor, or -1 with errno set. Some file systems have no files without a name; there the file has a name
// for a moment.
int open_unnamed(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL && errno != ENOENT)) return file;
  std::string name = (folder / "wavetracer_XXXXXX").string();
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) ::unlink(name.c_str());
  return named;
}

// Tells whether both names lead to the same file.
bool is_same(const struct stat& status, const fs::path& other) {
  struct stat there {};
  return ::stat(other.c_str(), &there) == 0 && there.st_dev == status.st_dev && there.st_ino == status.st_ino;
}

}  // namespace

fs::path behind_links(const fs::path& path) {
  fs::path at = path;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(at, error)); ++links) {
    if (links == most_links) refuse(path, std::strerror(ELOOP));
    const fs::path next = fs::read_symlink(at, error);
    if (error) refuse(path, error.message());
    at = next.is_absolute() ? next : at.parent_path() / next;
  }
  return at;
}

OutputPlace output_place(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    if (errno != ENOENT) refuse(path, std::strerror(errno));
    return {behind_links(path), false};
  }
  if (S_ISFIFO(status.st_mode) || S_ISCHR(status.st_mode)) {
    if (::access(path.c_str(), W_OK) != 0) refuse(path, std::strerror(errno));
    return {path, true};
  }
  if (!S_ISREG(status.st_mode)) refuse(path, words_for(status.st_mode));
  const fs::path target = behind_links(path);
  return is_same(status, target) ? OutputPlace{target, false} : OutputPlace{path, true};
}

void remove_old_file(const fs::path& path) noexcept {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return;
  const fs::path target = fs::canonical(path, error);
  if (!error) fs::remove(target, error);
}

fs::path temporary_beside(const fs::path& target) {
  fs::path temporary = target;
  temporary += fmt::format(".{}.tmp", ::getpid());
  return temporary;
}

std::vector<fs::path> temporary_folders() {
  std::vector<fs::path> out{"/tmp", "/var/tmp"};
  if (const std::string chosen = environment("TMPDIR"); !chosen.empty()) out.insert(out.begin(), chosen);
  return out;
}

int unnamed_file(const fs::path& wanted_for) {
  std::string problem;
  for (const fs::path& folder : temporary_folders()) {
    if (const int descriptor = open_unnamed(folder); descriptor >= 0) return descriptor;
    if (problem.empty())
      problem = fmt::format("no temporary file can be made in {} ({})", folder.string(), std::strerror(errno));
  }
  throw RuntimeError(
      fmt::format("cannot write {}: {}; set TMPDIR to a folder that can be written to", wanted_for.string(), problem));
}

fs::path nearest_existing(const fs::path& folder, std::error_code& error) {
  fs::path there = fs::absolute(folder, error).lexically_normal();
  while (!error && !fs::exists(there, error) && !error && there.has_relative_path()) there = there.parent_path();
  return there;
}

std::string write_obstacle(const fs::path& folder) {
  std::error_code error;
  const fs::path there = nearest_existing(folder, error);
  if (there.empty()) return error.message();
  const auto why = [&there](const std::string& what) { return fmt::format("{}: {}", there.string(), what); };
  if (error) return why(error.message());
  if (!fs::is_directory(there, error)) return why("not a folder");
  const int file = open_unnamed(there);
  if (file < 0) return why(errno == ENOENT ? "no file can be made there" : std::strerror(errno));
  constexpr std::array<char, 4096> block{};
  const bool written = ::write(file, block.data(), block.size()) == static_cast<ssize_t>(block.size());
  const int problem = errno;
  ::close(file);
  return written ? "" : why(std::strerror(problem));
}

}  // namespace wavetracer
