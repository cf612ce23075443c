// SPDX-License-Identifier: Apache-2.0
// Config files: TOML text in, a checked Config out, and back. `wavetracer init` explains every key; so does
// docs/configuration.md. Safe to call from several threads at once.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer {

// Reads the file; `sets` are `key=value` texts of `--set`, applied after it in order. A value is TOML, and other text
// is a string. Paths in the file are relative to its folder; paths in `sets`, and output.directory, are relative to the
// current folder. All errors are found at once and thrown as one ConfigError, one `file:line:column: ...` per line.
Config load_config(const std::filesystem::path& file, const std::vector<std::string>& sets = {});

// Does the same for text in memory; messages contain file_name, and relative paths start at its folder.
Config parse_config(std::string_view toml, const std::string& file_name, const std::vector<std::string>& sets = {});

// Returns a config file with every key, its meaning, unit, range and default; it is a small example that can be run.
std::string commented_config();

// Returns every key with its value in this Config, as a config file that reads back the same.
std::string resolved_config(const Config& config);

// Returns the same without the keys that do not change results: output.directory, and output.shard_frames if frames do
// not reuse sequences. Config::text is this text.
std::string echoed_config(const Config& config);

}  // namespace wavetracer
