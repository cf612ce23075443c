// SPDX-License-Identifier: Apache-2.0
// A temporary file that no other process sees: it has no name, and disappears with this object or with the process,
// however that ends. POSIX only.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace wavetracer {

class ScratchFile {
 public:
  // Creates the file on the file system of this path; it has the name path.PROCESS.tmp for a moment. All members throw
  // RuntimeError that names the path.
  explicit ScratchFile(std::filesystem::path path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  // Both may be called from any thread, for ranges that do not overlap.
  void write_at(uint64_t offset, std::span<const std::byte> bytes) const;
  void read_at(uint64_t offset, std::span<std::byte> bytes) const;
  // Frees the disk space of these bytes, where the file system can do that.
  void forget(uint64_t offset, uint64_t bytes) const noexcept;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;

  [[noreturn]] void fail(const char* doing, int error) const;
};

}  // namespace wavetracer
