// SPDX-License-Identifier: Apache-2.0
// The head of an HDF5 output: its attributes, and the groups that do not grow with frames.
// It is written in the same way whether it comes from a run or from a part of a run.
#pragma once
#include <filesystem>
#include "output/h5_outputs.hpp"
#include "output/hdf5.hpp"

namespace wavetracer {

// Writes into an empty file in memory. Both functions throw RuntimeError.
void make_head(const H5Output& output, const Run& run, hdf5::File& head);
// Copies another file's head: all groups that are not its growing ones.
void copy_head(const H5Output& output, const std::filesystem::path& file, hdf5::File& head);

}  // namespace wavetracer
