// paths.h5: every path of a run with its vertices, and what is needed to read them without wavetracer.
// The layout is listed in paths_h5.cpp, dataset by dataset, in the words that the file itself carries.
#pragma once
#include "output/hdf5.hpp"
#include "output/output.hpp"

namespace wavetracer {

// Fills an empty file in memory, whose image() then is the bytes of paths.h5. Throws RuntimeError.
void encode_paths_h5(const RunData& run, hdf5::File& file);

}  // namespace wavetracer
