// What differs between two configurations, key by key, for a message that says more than that they differ.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

// Texts as echoed_config() writes them: one key per line. Returns "trace.rays was 1000 and is 2000", in the order of
// the second text; what one of them lacks "was not given" or "is not given". Tables in double brackets have an index:
// transmitter.0.name.
std::vector<std::string> config_changes(std::string_view was, std::string_view is);

}  // namespace wavetracer
