// SPDX-License-Identifier: Apache-2.0
// The field table as text: the help of a key, docs/configuration.md, and the man page wavetracer.toml(5).
// `wavetracer documentation` generates the pages; nothing in them is written by hand.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wavetracer {

// Returns one paragraph per key, as `wavetracer help` prints it. topic: a table, or a key with or without its table;
// empty for all keys. Returns an empty text if there is nothing of this name.
std::string field_help(std::string_view topic = {});

}  // namespace wavetracer

namespace wavetracer::config {

// Returns text for a man page: characters with a meaning in roff are escaped, `...` becomes bold, "-" a plain
// hyphen-minus.
std::string roff(std::string_view text);

std::string markdown_reference();
std::string manual_page(std::string_view version);

// Returns all keys as --set takes them, with index 0 for arrays of tables: `mount.0.on`; and the words that each
// accepts, none if it accepts any value.
std::vector<std::pair<std::string, std::vector<std::string>>> settable_keys();

}  // namespace wavetracer::config
