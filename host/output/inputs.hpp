// The input files of a run, in its outputs, and what differs between those of two runs.
// Where files lie makes no difference; what they hold does.
#pragma once
#include <string>
#include <vector>
#include "output/hdf5.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// /inputs of paths.h5.
void write_inputs(hdf5::File& file, const std::vector<InputFile>& inputs);

// The first file that is not as it was, for a message; empty where all are.
std::string changed_input(const std::vector<InputFile>& before, const std::vector<InputFile>& now);

}  // namespace wavetracer
