// Files of consecutive frames, made one: the groups that grow with frames, a block of rows at a time.
// A copy rather than a virtual dataset, because HDF5 fills in for parts that it cannot open, and says nothing: parts
// that were left behind, or more parts than a process may have open files (measured with 1500 of them).
#pragma once
#include <filesystem>
#include <span>
#include "output/hdf5.hpp"

namespace wavetracer {

// parts: files of one kind and run, in the order of their frames, at least one. Into `merged` go these groups of them,
// as if all frames had been encoded at once. Throws RuntimeError.
void merge_frames_h5(std::span<const std::filesystem::path> parts, std::span<const char* const> groups,
                     const hdf5::File& merged);

}  // namespace wavetracer
