// A file that nobody else sees: it has no name, and goes with this object or the process, however that ends.
// POSIX only.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace wavetracer {

class ScratchFile {
 public:
  // On the file system of this path, under whose name (and .PROCESS.tmp) it appears for an instant. All throw
  // RuntimeError that names the path.
  explicit ScratchFile(std::filesystem::path path);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  // Both from any thread, at places of their own.
  void write_at(uint64_t offset, std::span<const std::byte> bytes) const;
  void read_at(uint64_t offset, std::span<std::byte> bytes) const;
  // Gives the room of these bytes back, where the file system can do that.
  void forget(uint64_t offset, uint64_t bytes) const noexcept;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;

  [[noreturn]] void fail(const char* doing, int error) const;
};

}  // namespace wavetracer
