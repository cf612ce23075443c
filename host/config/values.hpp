// SPDX-License-Identifier: Apache-2.0
// Checks a value of a TOML node against the field table and stores it in a member.
// This is the only header of this folder that names toml++; literal() in field_table.hpp writes TOML text.
#pragma once
#include <toml++/toml.h>
#include <filesystem>
#include <string>
#include "config/field_table.hpp"

namespace wavetracer::config {

// Checks the value against the field and stores it; relative paths start at `folder`.
// Returns what is wrong, without the place, in words that name `key`; empty if the value is valid.
std::string assign(const Field& field, const std::string& key, const Slot& slot, const toml::node& value,
                   const std::filesystem::path& folder);

// Returns an absolute path without . and .. parts; a relative one starts at `folder`. Empty stays empty.
std::string resolved_path(const std::filesystem::path& folder, const std::string& path);

}  // namespace wavetracer::config
