// SPDX-License-Identifier: Apache-2.0
// Writes the list of a run's input files, and finds differences between the lists of two runs.
// The places of files do not matter; their contents do.
#pragma once
#include <string>
#include <vector>
#include "output/hdf5.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// Writes /inputs of paths.h5.
void write_inputs(hdf5::File& file, const std::vector<InputFile>& inputs);

// Returns the first file that has changed, for a message; empty if none has.
std::string changed_input(const std::vector<InputFile>& before, const std::vector<InputFile>& now);

}  // namespace wavetracer
