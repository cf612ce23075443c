// SPDX-License-Identifier: Apache-2.0
// One syncfs() syncs all files of the folder together, which matters for thousands of small ones.
// It assumes that rename() replaces an empty folder, as POSIX says; a link to a folder stays a link.
#include "base/pending_folder.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include "base/file.hpp"
#include "base/output_place.hpp"
#include "base/pending_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw RuntimeError(
      fmt::format("cannot write {}: {}; choose another folder with -o", path.string(), std::strerror(error)));
}

fs::path without_slash(const fs::path& path) { return path.has_filename() ? path : path.parent_path(); }

}  // namespace

PendingFolder::PendingFolder(fs::path path, Earlier earlier) : path_(behind_links(without_slash(path))) {
  std::error_code error;
  const bool there = fs::exists(path_, error), folder = fs::is_directory(path_, error);
  if (there && !folder)
    throw InputError(fmt::format("{}: this is no folder; choose another name with -o", path.string()));
  if (there && earlier == Earlier::refused && !fs::is_empty(path_, error))
    throw InputError(fmt::format("{}: exists already; remove it or choose another folder with -o", path.string()));
  const fs::path temporary = temporary_beside(path_);
  const auto hold = hold_pending();
  if (!fs::create_directory(temporary, error)) fail(path_, error ? error.value() : EEXIST);
  temporary_ = temporary;
}

PendingFolder::~PendingFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void PendingFolder::append(const fs::path& name, std::span<const std::byte> bytes) const {
  const auto hold = hold_pending();
  const fs::path file = temporary_ / name;
  std::error_code error;
  if (name.has_parent_path()) fs::create_directories(file.parent_path(), error);
  if (error) fail(path_ / name, error.value());
  errno = 0;
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) fail(path_ / name, errno != 0 ? errno : EIO);
}

void PendingFolder::move_into_place() {
  std::error_code error;
  const bool joins = fs::exists(path_, error) && !fs::is_empty(path_, error);
  if (joins) write_through_links();
  const auto hold = hold_pending();
  if (!joins) {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, errno);
  } else {
    for (const fs::directory_entry& file : fs::directory_iterator(temporary_)) {
      const fs::path place = path_ / file.path().filename();
      if (std::rename(file.path().c_str(), place.c_str()) != 0) fail(place, errno);
    }
    sync_folder(path_);
    fs::remove(temporary_, error);
  }
  temporary_.clear();
  ++final_names();
}

// Handles files whose names are links, pipes or devices in the target folder: a rename would replace those.
void PendingFolder::write_through_links() const {
  for (const fs::directory_entry& file : fs::directory_iterator(temporary_)) {
    const fs::path place = path_ / file.path().filename();
    std::error_code none;
    const fs::file_status status = fs::symlink_status(place, none);
    if (!fs::exists(status) || fs::is_regular_file(status) || fs::is_directory(status)) continue;
    write_file(place, read_file(file.path()));
    fs::remove(file.path());
  }
}

fs::path PendingFolder::commit() {
  const int descriptor = ::open(temporary_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail(path_, errno);
  const int error = ::syncfs(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0) fail(path_, error);
  move_into_place();
  sync_folder(path_.has_parent_path() ? path_.parent_path() : fs::path("."));
  return path_;
}

}  // namespace wavetracer
