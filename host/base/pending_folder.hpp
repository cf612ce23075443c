// SPDX-License-Identifier: Apache-2.0
// A folder of files that appears completely or not at all: it is filled beside its final place, synced, then renamed.
// The disk is waited for once, however many files there are.
// By default a folder that is not empty is refused: files of an earlier export would be read as part of this one.
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace wavetracer {

class PendingFolder {
 public:
  enum class Earlier { refused, kept };  // the treatment of files that are in the folder already

  // Throws InputError if the path exists and is not an empty folder, RuntimeError if it cannot be made. With
  // Earlier::kept the files are added to those of the folder or replace them, one by one, once all are on the disk;
  // file names must then not contain folders.
  explicit PendingFolder(std::filesystem::path path, Earlier earlier = Earlier::refused);
  ~PendingFolder();
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;

  // Appends to the file of that name, relative to the folder; creates it and its parents if missing. Throws
  // RuntimeError.
  void append(const std::filesystem::path& name, std::span<const std::byte> bytes) const;
  void append(const std::filesystem::path& name, std::string_view text) const {
    append(name, std::as_bytes(std::span(text)));
  }
  // Moves the folder to its final place and returns that place.
  std::filesystem::path commit();

 private:
  void move_into_place();
  void write_through_links() const;

  std::filesystem::path path_, temporary_;  // temporary_ is empty after commit()
};

}  // namespace wavetracer
