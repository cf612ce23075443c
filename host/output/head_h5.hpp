// The head of an HDF5 output: its attributes, and the groups that do not grow with frames.
// Written in one way, whether it comes from a run or from a part that a run has left.
#pragma once
#include <filesystem>
#include "output/h5_outputs.hpp"
#include "output/hdf5.hpp"

namespace wavetracer {

// Into an empty file in memory. Both throw RuntimeError.
void make_head(const H5Output& output, const Run& run, hdf5::File& head);
// What another file has for a head: all that is not in its growing groups.
void copy_head(const H5Output& output, const std::filesystem::path& file, hdf5::File& head);

}  // namespace wavetracer
