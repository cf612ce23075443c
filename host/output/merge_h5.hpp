// SPDX-License-Identifier: Apache-2.0
// Merges files of consecutive frames into one: the groups that grow with frames.
// Rows are copied instead of using a virtual dataset, because HDF5 silently fills in values for parts that it cannot
// open: missing parts, or more parts than a process may have open files (measured with 1500 of them).
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include "output/table_layout.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

// Reads a part; a RuntimeError becomes an InputError that names the part.
template <typename Read>
auto reading_part(const std::filesystem::path& part, const Read& read) {
  try {
    return read();
  } catch (const RuntimeError& error) {
    throw InputError(part.string() + ": " + error.what() + "; compute it again with --resume");
  }
}

// Called with each part before it is opened.
using BeginPart = std::function<void(const std::filesystem::path&)>;

// Collects files of one kind and run, in the order of their frames: these groups of all files, as if all frames had
// been appended to one. The rows are not copied.
class GrowingParts {
 public:
  struct RunOfPart {
    std::vector<std::string> names, files;  // lists of the inputs
    std::vector<uint64_t> hashes;
    std::string config;
  };
  explicit GrowingParts(std::vector<std::string> groups) : names_(std::move(groups)) {}
  // Adds the next file. Throws InputError that names the file and the dataset if it belongs to another run than the
  // first, or has other datasets, types or shapes, or lacks rows; nothing may be added after that.
  void add(const std::filesystem::path& part);
  const std::vector<GrowingGroup>& groups() const& { return groups_; }
  std::vector<GrowingGroup> groups() && { return std::move(groups_); }
  const std::vector<std::filesystem::path>& parts() const { return parts_; }

 private:
  std::vector<std::string> names_;
  std::optional<RunOfPart> first_;
  std::vector<GrowingGroup> groups_;
  std::vector<std::filesystem::path> parts_;
};

// Returns the groups of these parts, at least one. Throws as GrowingParts::add() does.
std::vector<GrowingGroup> growing_groups_of(std::span<const std::filesystem::path> parts,
                                            const std::vector<std::string>& groups, const BeginPart& begin);

// parts: those of blocks of one frame, whose links are side by side.
std::vector<GrowingGroup> groups_of_blocks(std::span<const std::filesystem::path> parts,
                                           const std::vector<std::string>& groups, const BeginPart& begin);

}  // namespace wavetracer
