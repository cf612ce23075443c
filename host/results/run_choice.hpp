// SPDX-License-Identifier: Apache-2.0
// Finds the ends, frames and grids of a run that a user names.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

// Returns the index of an end by its name, or nothing if the name is empty. option: such as "--tx", for the error.
// Throws ConfigError.
std::optional<uint32_t> find_end(const std::vector<RadioEnd>& ends, const std::string& name, const std::string& option);

// Returns the row of a frame by its number. Throws ConfigError.
size_t find_frame(const SavedRun& run, uint32_t number);

// Returns the grid of this name, of those of the run's configuration. Throws ConfigError, which names the option
// --grid.
const ReceiverGridConfig& find_grid(const std::vector<ReceiverGridConfig>& grids, const std::string& name);

}  // namespace wavetracer
