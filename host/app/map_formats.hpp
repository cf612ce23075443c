// SPDX-License-Identifier: Apache-2.0
// The option --format of commands that write maps.
#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>
#include "scene/georeference.hpp"

namespace wavetracer::app {

// Adds the option.
CLI::Option* add_map_formats(CLI::App& command, std::vector<std::string>& formats);

// Throws ConfigError for a word that is no format.
void check_map_formats(const std::vector<std::string>& formats);

bool has_format(const std::vector<std::string>& formats, const std::string& format);

// Returns a warning for files that have a place in the scene's own coordinates alone; empty if there are none.
std::string place_warning(const std::vector<std::string>& formats, const std::optional<Georeference>& georeference);

}  // namespace wavetracer::app
