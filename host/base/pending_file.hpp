// Files that appear whole or not at all: written beside their place, synced, then renamed. Links are followed. A device
// or a pipe stays what it is and gets the bytes once they are complete.
// POSIX only: rename() replaces atomically within one folder.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace wavetracer {

// Creates a folder with its parents; removes again what it created unless keep() is called.
class PendingDirectory {
 public:
  // Throws RuntimeError when the folder cannot be made or the path names something else.
  explicit PendingDirectory(std::filesystem::path path);
  ~PendingDirectory();
  PendingDirectory(const PendingDirectory&) = delete;
  PendingDirectory& operator=(const PendingDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void keep() { created_.clear(); }

 private:
  void remove_created() noexcept;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> created_;  // outermost first
};

// One file on its way to its place. Every failure is a RuntimeError that names the file.
class PendingFile {
 public:
  // An empty temporary file beside the place, which goes away unless it is committed. The place is where links lead to.
  // For a pipe or a device the temporary file has no name and lies in TMPDIR. Folders, sockets and disks are refused.
  explicit PendingFile(std::filesystem::path path);
  // The same with these bytes in it, synced; leaves nothing if that fails.
  PendingFile(std::filesystem::path path, std::span<const std::byte> bytes);
  ~PendingFile();
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  // Appends.
  void write(std::span<const std::byte> bytes);
  // At a place of its own, from any thread.
  void write_at(uint64_t offset, std::span<const std::byte> bytes) const;
  // Makes the file so long, on the disk too: who writes into it afterwards meets no full disk.
  void reserve(uint64_t size);
  // Waits for the disk; nothing is written after it.
  void sync();
  // Renames the synced temporary file to its name and syncs the folder. A pipe or a device gets the bytes instead,
  // which waits until somebody reads the pipe.
  void commit();

 private:
  std::filesystem::path path_;       // as the caller named it
  std::filesystem::path target_;     // where links lead to
  std::filesystem::path temporary_;  // empty once committed or moved from
  bool stream_ = false;              // a pipe or a device
  int descriptor_ = -1;              // closed by sync(), of a stream by commit()

  friend void commit_together(std::vector<PendingFile>& files);
  void rename();
  void pour();
  void undo() const noexcept;
};

// Commits all or none: if one fails, those already in place are removed and the error goes on. Each folder is synced
// once, after the last.
void commit_together(std::vector<PendingFile>& files);

// Appends to a file that is there and waits for the disk. Throws RuntimeError.
void append_to_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Waits until names that appeared in the folder or went are on the disk. Throws RuntimeError.
void sync_folder(const std::filesystem::path& folder);

}  // namespace wavetracer
