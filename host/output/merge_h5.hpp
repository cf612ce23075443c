// Files of consecutive frames, made one: the groups that grow with frames.
// A copy rather than a virtual dataset, because HDF5 fills in for parts that it cannot open, and says nothing: parts
// that were left behind, or more parts than a process may have open files (measured with 1500 of them).
#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include "output/copy_pieces.hpp"
#include "output/hdf5.hpp"
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

// parts: files of one kind and run, in the order of their frames, at least one. Makes these groups of them in `merged`,
// as if all frames had been encoded at once, but for the rows: the pieces say where those are and belong, once `merged`
// is closed. begin is told each part before it is opened. Throws InputError that names the part and the dataset, where
// a part has other datasets than the first, or of other types or shapes, or not all of their rows.
using BeginPart = std::function<void(const std::filesystem::path&)>;
Pieces merge_frames_h5(std::span<const std::filesystem::path> parts, std::span<const char* const> groups,
                       const hdf5::File& merged, const BeginPart& begin);

}  // namespace wavetracer
