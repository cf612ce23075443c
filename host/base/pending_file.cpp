// SPDX-License-Identifier: Apache-2.0
// Makes files appear completely or not at all: temporary name, fsync, rename, fsync of the folder.
// It assumes a file system whose rename() is atomic.
#include "base/pending_file.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <set>
#include <utility>
#include "base/output_place.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

std::string advice(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space there, raise the limit, or choose another folder with -o";
    case EACCES:
    case EPERM:
    case EROFS:
      return "check the permissions of its folder or choose another one with -o";
    default:
      return "choose another folder with -o";
  }
}

[[noreturn]] void fail(const fs::path& path, const char* doing, int error) {
  throw RuntimeError(fmt::format("cannot {} {}: {}; {}", doing, path.string(), std::strerror(error), advice(error)));
}

// Returns 0, or the errno of the call that failed.
int write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), std::min<size_t>(bytes.size(), size_t{1} << 30));
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
  return 0;
}

// Network file systems report failed writes in close().
int sync_and_close(int descriptor) {
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  return ::close(descriptor) == 0 || error != 0 ? error : errno;
}

// While it exists, writing to a pipe without a reader is an error of write() for this thread and does not end the
// process.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec now{};
    if (sigismember(&before_, SIGPIPE) == 0) sigtimedwait(&pipe_, nullptr, &now);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_, before_;
};

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

std::mutex naming;

}  // namespace

PendingDirectory::PendingDirectory(fs::path path) : path_(path.empty() ? fs::path(".") : std::move(path)) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path p = path_; !p.empty() && !fs::exists(p, error); p = p.parent_path()) {
    if (error) fail(path_, "create the folder", error.value());
    if (p.has_filename()) missing.push_back(p);  // for "a/", whose parent is "a", nothing is added
  }
  std::reverse(missing.begin(), missing.end());
  for (const fs::path& p : missing) {
    const auto hold = hold_pending();
    if (fs::create_directory(p, error)) {
      created_.push_back(p);
    } else if (error) {
      remove_created();  // the constructor throws from here on, so the destructor will not run
      fail(path_, "create the folder", error.value());
    }
  }
  if (!fs::is_directory(path_, error)) {
    remove_created();
    throw RuntimeError(fmt::format(
        "cannot write into {}: it is not a folder; move it away or choose another one with -o", path_.string()));
  }
}

PendingDirectory::~PendingDirectory() { remove_created(); }

void PendingDirectory::remove_created() noexcept {
  std::error_code ignored;  // a folder that somebody else has put files into stays
  for (auto p = created_.rbegin(); p != created_.rend(); ++p) fs::remove(*p, ignored);
}

PendingFile::PendingFile(fs::path path) : path_(std::move(path)) {
  const OutputPlace place = output_place(path_);
  target_ = place.target;
  stream_ = place.stream;
  if (stream_) {
    descriptor_ = unnamed_file(path_);
    temporary_ = fmt::format("/proc/self/fd/{}", descriptor_);
    return;
  }
  temporary_ = temporary_beside(target_);
  const auto hold = hold_pending();
  descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail(path_, "write", errno);
}

PendingFile::PendingFile(fs::path path, std::span<const std::byte> bytes) : PendingFile(std::move(path)) {
  write(bytes);  // the delegated constructor is done, so the destructor runs if this throws
  sync();
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, fs::path())),
      stream_(other.stream_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty() && !stream_) fs::remove(temporary_, ignored);
}

void PendingFile::write(std::span<const std::byte> bytes) {
  if (const int error = write_all(descriptor_, bytes)) fail(path_, "write", error);
}

void PendingFile::write_at(uint64_t offset, std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno != EINTR) fail(path_, "write", errno);
    if (written <= 0) continue;
    offset += static_cast<uint64_t>(written);
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
}

void PendingFile::reserve(uint64_t size) {
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(descriptor_, 0, static_cast<off_t>(size));
  if (error != 0) fail(path_, "write", error);
}

void PendingFile::sync() {
  if (stream_) return;  // its nameless temporary file disappears when the descriptor is closed
  if (const int error = sync_and_close(std::exchange(descriptor_, -1))) fail(path_, "write", error);
}

void PendingFile::rename() {
  if (stream_) return pour();
  const auto hold = hold_pending();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, "write", errno);
  temporary_.clear();
  ++final_names();
}

// This does not hold hold_pending(), since a pipe may block for ever.
void PendingFile::pour() {
  const int out = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (out < 0) fail(path_, "write", errno);
  const NoPipeSignal quiet;
  std::array<std::byte, 1 << 16> block;
  off_t at = 0;
  int error = 0;
  while (error == 0) {
    const ssize_t read = ::pread(descriptor_, block.data(), block.size(), at);
    if (read == 0) break;
    error = read < 0 ? errno : write_all(out, std::span(block).first(static_cast<size_t>(read)));
    at += std::max<ssize_t>(read, 0);
  }
  if (::close(out) != 0 && error == 0) error = errno;
  if (error != 0) fail(path_, "write", error);
  ::close(std::exchange(descriptor_, -1));
  temporary_.clear();
  ++final_names();
}

void PendingFile::undo() const noexcept {
  std::error_code ignored;
  if (!stream_) fs::remove(target_, ignored);
}

void PendingFile::commit() {
  rename();
  if (!stream_) sync_folder(folder_of(target_));
}

void commit_together(std::vector<PendingFile>& files) {
  size_t committed = 0;
  try {
    std::set<fs::path> folders;
    for (; committed < files.size(); ++committed) {
      files[committed].rename();
      if (!files[committed].stream_) folders.insert(folder_of(files[committed].target_));
    }
    for (const fs::path& folder : folders) sync_folder(folder);
  } catch (...) {
    for (size_t i = 0; i < committed; ++i) files[i].undo();
    throw;
  }
}

void append_to_file(const fs::path& path, std::span<const std::byte> bytes) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor < 0) fail(path, "write", errno);
  const int written = write_all(descriptor, bytes), synced = sync_and_close(descriptor);
  if (written != 0 || synced != 0) fail(path, "write", written != 0 ? written : synced);
}

void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail(folder, "sync the folder", errno);
  // EINVAL means that this file system cannot sync folders, so there is nothing to wait for.
  const int error = ::fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  ::close(descriptor);
  if (error != 0) fail(folder, "sync the folder", error);
}

std::atomic<uint64_t>& final_names() {
  static std::atomic<uint64_t> count{0};
  return count;
}

std::unique_lock<std::mutex> hold_pending() { return std::unique_lock(naming); }

}  // namespace wavetracer
