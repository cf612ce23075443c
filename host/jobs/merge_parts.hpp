// SPDX-License-Identifier: Apache-2.0
// The files from which the outputs of a run are made.
// These are names only: nothing is opened here.
#pragma once
#include <filesystem>
#include <vector>

namespace wavetracer {

struct MergeParts {
  // [file][part]: the files of h5_outputs() in their order, then .csv; parts in the order of their units, at least one.
  std::vector<std::vector<std::filesystem::path>> files;
  bool of_one_frame = false;  // parts are blocks of transmitters, in their order
};

}  // namespace wavetracer
