// SPDX-License-Identifier: Apache-2.0
// Checks whether a folder of shards belongs to the run that was asked for.
#pragma once
#include <filesystem>
#include <string>
#include <vector>
#include "jobs/manifest.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// there: identity of the run that wrote the shards in this folder. config, inputs: the text of the configuration and
// the inputs of the run that was asked for, for messages. Throws ConfigError that names the keys or the option that
// differ, and InputError that names the input file that has changed since.
void check_same_run(const RunIdentity& there, const RunIdentity& asked, const std::filesystem::path& folder,
                    const std::string& config, const std::vector<InputFile>& inputs);

}  // namespace wavetracer
