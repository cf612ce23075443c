// Names by pattern: * stands for any text, also none, and ? for any one character; all else stands for itself.
// Characters are bytes, which suits names in ASCII.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

bool matches(std::string_view pattern, std::string_view name);

// Throws ConfigError, with the name nearest to the pattern, unless one of the names matches. `*` needs no name.
// key: what the message begins with, "links.receivers"; what: one of the things that are named, "receiver".
void require_match(std::string_view pattern, const std::vector<std::string>& names, std::string_view key,
                   std::string_view what);

}  // namespace wavetracer
