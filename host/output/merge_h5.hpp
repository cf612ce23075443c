// Files of consecutive frames, made one: the groups that grow with frames.
// A copy rather than a virtual dataset, because HDF5 fills in for parts that it cannot open, and says nothing: parts
// that were left behind, or more parts than a process may have open files (measured with 1500 of them).
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

// What reads a part: its RuntimeError becomes an InputError that names the part.
template <typename Read>
auto reading_part(const std::filesystem::path& part, const Read& read) {
  try {
    return read();
  } catch (const RuntimeError& error) {
    throw InputError(part.string() + ": " + error.what() + "; compute it again with --resume");
  }
}

// Is told each part before it is opened.
using BeginPart = std::function<void(const std::filesystem::path&)>;

// Files of one kind and run, in the order of their frames: these groups of all of them, as if all frames had been
// appended at once; the rows stay where they are.
class GrowingParts {
 public:
  struct RunOfPart {
    std::vector<std::string> names, files;  // of the inputs
    std::vector<uint64_t> hashes;
    std::string config;
  };
  // groups: must outlive it.
  explicit GrowingParts(std::span<const char* const> groups) : names_(groups) {}
  // The next file. Throws InputError that names it and the dataset, where it is of another run than the first, has
  // other datasets, or of other types or shapes, or not all of their rows; nothing may be added then.
  void add(const std::filesystem::path& part);
  const std::vector<GrowingGroup>& groups() const& { return groups_; }
  std::vector<GrowingGroup> groups() && { return std::move(groups_); }
  const std::vector<std::filesystem::path>& parts() const { return parts_; }

 private:
  std::span<const char* const> names_;
  std::optional<RunOfPart> first_;
  std::vector<GrowingGroup> groups_;
  std::vector<std::filesystem::path> parts_;
};

// Those of parts, at least one. Throws as GrowingParts::add() does.
std::vector<GrowingGroup> growing_groups_of(std::span<const std::filesystem::path> parts,
                                            std::span<const char* const> groups, const BeginPart& begin);

// parts: of blocks of one frame, whose links are side by side.
std::vector<GrowingGroup> groups_of_blocks(std::span<const std::filesystem::path> parts,
                                           std::span<const char* const> groups, const BeginPart& begin);

}  // namespace wavetracer
