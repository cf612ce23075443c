// Files of consecutive frames, made one: the groups that grow with frames.
// A copy rather than a virtual dataset, because HDF5 fills in for parts that it cannot open, and says nothing: parts
// that were left behind, or more parts than a process may have open files (measured with 1500 of them).
#pragma once
#include <filesystem>
#include <functional>
#include <span>
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

// parts: files of one kind and run, in the order of their frames, at least one. These groups of all of them, as if all
// frames had been appended at once; the rows stay where they are. Throws InputError that names the part and the
// dataset, where a part is of another run than the first, has other datasets, or of other types or shapes, or not all
// of their rows.
std::vector<GrowingGroup> growing_groups_of(std::span<const std::filesystem::path> parts,
                                            std::span<const char* const> groups, const BeginPart& begin);

// parts: of blocks of one frame, whose links are side by side.
std::vector<GrowingGroup> groups_of_blocks(std::span<const std::filesystem::path> parts,
                                           std::span<const char* const> groups, const BeginPart& begin);

}  // namespace wavetracer
