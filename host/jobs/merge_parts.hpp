// Which files make the outputs of a run.
// Only names: nothing is opened here.
#pragma once
#include <filesystem>
#include <vector>

namespace wavetracer {

struct MergeParts {
  // [file][part]: those of h5_outputs() in their order, then .csv; parts in the order of their units, at least one.
  std::vector<std::vector<std::filesystem::path>> files;
  bool of_one_frame = false;  // blocks of transmitters, in their order
};

}  // namespace wavetracer
