// One syncfs() for the whole folder: thousands of small files are synced together.
// Assumes that rename() replaces an empty folder, as POSIX has it.
#include "base/pending_folder.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include "base/pending_file.hpp"
#include "base/pending_hold.hpp"
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

PendingFolder::PendingFolder(fs::path path, Earlier earlier) : path_(without_slash(path)) {
  std::error_code error;
  const bool may_be_full = earlier == Earlier::kept;
  if (fs::exists(path_, error) && !(fs::is_directory(path_, error) && (may_be_full || fs::is_empty(path_, error))))
    throw InputError(fmt::format("{}: exists already; remove it or choose another folder with -o", path_.string()));
  fs::path temporary = path_;
  temporary += fmt::format(".{}.tmp", ::getpid());
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
  const auto hold = hold_pending();
  std::error_code error;
  if (!fs::exists(path_, error) || fs::is_empty(path_, error)) {
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
