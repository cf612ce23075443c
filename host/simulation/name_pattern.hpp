// SPDX-License-Identifier: Apache-2.0
// Names by pattern: * matches any text, also an empty one, ? matches one character; all other characters match
// themselves.
// Characters are bytes, which suits names in ASCII.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

bool matches(std::string_view pattern, std::string_view name);

// Throws ConfigError, with the name nearest to the pattern, unless one of the names matches. `*` needs no name.
// key: the beginning of the message, "links.receivers"; what: the kind of the names, "receiver".
void require_match(std::string_view pattern, const std::vector<std::string>& names, std::string_view key,
                   std::string_view what);

}  // namespace wavetracer
