// Values of the field table: from a TOML node into a member, checked.
// The only header of this folder that names toml++; the way back, to TOML text, is literal() in field_table.hpp.
#pragma once
#include <toml++/toml.h>
#include <filesystem>
#include <string>
#include "config/field_table.hpp"

namespace wavetracer::config {

// Checks the value against the field and stores it; relative paths are taken from `folder`.
// Returns what is wrong, without the place, in words that name `key`; empty when all is well.
std::string assign(const Field& field, const std::string& key, const Slot& slot, const toml::node& value,
                   const std::filesystem::path& folder);

// An absolute path without . and .. parts; a relative one starts at `folder`. Empty stays empty.
std::string resolved_path(const std::filesystem::path& folder, const std::string& path);

}  // namespace wavetracer::config
