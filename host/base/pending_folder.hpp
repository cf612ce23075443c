// A folder of files that appears whole or not at all: filled beside its place, synced, then renamed. However many files
// there are, the disk is waited for once.
// Unless it is asked to, it never touches a folder with something in it: what an earlier export left there would be
// read as part of this one.
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace wavetracer {

class PendingFolder {
 public:
  enum class Earlier { refused, kept };  // files that are in the folder already

  // Throws InputError where the path is there already and no empty folder, RuntimeError where it cannot be made. With
  // Earlier::kept the files join those of the folder, or replace them, one by one once all are on the disk; names are
  // then without folders.
  explicit PendingFolder(std::filesystem::path path, Earlier earlier = Earlier::refused);
  ~PendingFolder();
  PendingFolder(const PendingFolder&) = delete;
  PendingFolder& operator=(const PendingFolder&) = delete;

  // Adds to the file of that name, relative to the folder, and makes it with its parents where it is not there.
  // Throws RuntimeError.
  void append(const std::filesystem::path& name, std::span<const std::byte> bytes) const;
  void append(const std::filesystem::path& name, std::string_view text) const {
    append(name, std::as_bytes(std::span(text)));
  }
  // Puts the folder in its place and returns that.
  std::filesystem::path commit();

 private:
  void move_into_place();
  void write_through_links() const;

  std::filesystem::path path_, temporary_;  // temporary_ is empty once committed
};

}  // namespace wavetracer
