// SPDX-License-Identifier: Apache-2.0
// The file is unlinked as soon as it is open. If the process is killed between the two calls, a temporary file remains.
#include "base/scratch_file.hpp"
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <utility>
#include "base/pending_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

ScratchFile::ScratchFile(std::filesystem::path path) : path_(std::move(path)) {
  const std::string name = fmt::format("{}.{}.tmp", path_.string(), ::getpid());
  const auto hold = hold_pending();
  descriptor_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor_ < 0) fail("write", errno);
  ::unlink(name.c_str());
}

ScratchFile::~ScratchFile() { ::close(descriptor_); }

void ScratchFile::write_at(uint64_t offset, std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno != EINTR) fail("write", errno);
    if (written <= 0) continue;
    offset += static_cast<uint64_t>(written);
    bytes = bytes.subspan(static_cast<size_t>(written));
  }
}

void ScratchFile::read_at(uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t read = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (read < 0 && errno == EINTR) continue;
    if (read <= 0) fail("read", read < 0 ? errno : EIO);
    offset += static_cast<uint64_t>(read);
    bytes = bytes.subspan(static_cast<size_t>(read));
  }
}

void ScratchFile::forget(uint64_t offset, uint64_t bytes) const noexcept {
  (void)::fallocate(descriptor_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(offset),
                    static_cast<off_t>(bytes));
}

void ScratchFile::fail(const char* doing, int error) const {
  throw RuntimeError(
      fmt::format("cannot {} a temporary file beside {}: {}", doing, path_.string(), std::strerror(error)));
}

}  // namespace wavetracer
