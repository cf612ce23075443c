// SPDX-License-Identifier: Apache-2.0
// Options that would change nothing are refused, so that nobody believes that they did.
#pragma once
#include <CLI/App.hpp>
#include <initializer_list>
#include <string>

namespace wavetracer::app {

// Throws ConfigError if one of these options was given: "NAME: REASON; leave it out".
void refuse_options(const CLI::App& command, std::initializer_list<const char*> names, const std::string& reason);

// The same for all options of a group of the help.
void refuse_group(const CLI::App& command, const std::string& group, const std::string& reason);

}  // namespace wavetracer::app
