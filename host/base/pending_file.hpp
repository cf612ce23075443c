// SPDX-License-Identifier: Apache-2.0
// Files that appear completely or not at all: they are written beside their final place, synced, then renamed. Links
// are followed. A device or a pipe is not replaced: it gets the bytes once they are complete.
// This is for POSIX only, where rename() replaces a file atomically within a folder.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <vector>

namespace wavetracer {

// Creates a folder and its missing parents, and removes them again unless keep() is called.
class PendingDirectory {
 public:
  // Throws RuntimeError if the folder cannot be made or the path is not a folder.
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

// A file that is being written and not yet in its place. Every failure is a RuntimeError that names the file.
class PendingFile {
 public:
  // Creates an empty temporary file beside the final place, with links followed; it is removed unless commit() is
  // called. For a pipe or a device the temporary file has no name and lies in TMPDIR. Folders, sockets and disks are
  // refused.
  explicit PendingFile(std::filesystem::path path);
  // Does the same, then writes and syncs the bytes. It leaves no file behind if that fails.
  PendingFile(std::filesystem::path path, std::span<const std::byte> bytes);
  ~PendingFile();
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& temporary() const { return temporary_; }
  // Appends the bytes.
  void write(std::span<const std::byte> bytes);
  // Writes the bytes at an offset. It may be called from any thread.
  void write_at(uint64_t offset, std::span<const std::byte> bytes) const;
  // Extends the file to this size and reserves the disk space, so that later writes do not fail because the disk is
  // full.
  void reserve(uint64_t size);
  // Waits until the file is on the disk. Nothing may be written after it.
  void sync();
  // Renames the synced temporary file to its name and syncs the folder. A pipe or a device gets the bytes instead; for
  // a pipe that waits until somebody reads it.
  void commit();

 private:
  std::filesystem::path path_;       // the name as the caller gave it
  std::filesystem::path target_;     // the name with links followed
  std::filesystem::path temporary_;  // empty after commit() or a move
  bool stream_ = false;              // it is a pipe or a device
  int descriptor_ = -1;              // closed by sync(), or by commit() for a pipe or device

  friend void commit_together(std::vector<PendingFile>& files);
  void rename();
  void pour();
  void undo() const noexcept;
};

// Commits all files or none: if one fails, those that are in place already are removed and the error is rethrown. Each
// folder is synced once, at the end.
void commit_together(std::vector<PendingFile>& files);

// Appends to an existing file and waits for the disk. Throws RuntimeError.
void append_to_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Waits until added and removed names of the folder are on the disk. Throws RuntimeError.
void sync_folder(const std::filesystem::path& folder);

// A lock for code that removes unfinished files when the process is told to end. While it is held, no temporary file or
// folder is created, gets another file, or gets its final name. It waits for files that are
// being created or renamed at the moment. A thread must not call it twice without releasing the lock.
std::unique_lock<std::mutex> hold_pending();

// The number of files and folders that got their final names in this process. It is changed only while hold_pending()
// is held.
std::atomic<uint64_t>& final_names();

}  // namespace wavetracer
