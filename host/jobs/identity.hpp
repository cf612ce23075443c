// SPDX-License-Identifier: Apache-2.0
// Tells which run the parts in a folder belong to: parts of two runs must not be mixed.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>
#include "jobs/frame_range.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// Values that must agree between the runs that fill one folder.
struct RunIdentity {
  std::string version;
  std::string config;            // hash of its text, without the folder of outputs and the places of input files
  std::string device_kind;       // "cpu" or "gpu"
  uint32_t first = 0, last = 0;  // frames that were asked for
  uint32_t repeat = 1;           // repeats share the seconds of a frame
  std::string inputs = {};       // hash of the contents of input files, which run.json lists
  bool operator==(const RunIdentity&) const = default;
};

// Two runs with the same identity write the same frames: version, kind of device, configuration, contents of all input
// files, frames and repeats. The places of outputs and inputs, and whether shards are kept, do not count.
RunIdentity identity_of(const Config& config, const RunSummary& summary, const FrameRange& range);

// there: identity of the run that wrote the shards in this folder. config, inputs: the text of the configuration and
// the inputs of the run that was asked for, for messages. Throws ConfigError that names the keys or the option that
// differ, and InputError that names the input file that has changed since.
void check_same_run(const RunIdentity& there, const RunIdentity& asked, const std::filesystem::path& folder,
                    const std::string& config, const std::vector<InputFile>& inputs);

}  // namespace wavetracer
