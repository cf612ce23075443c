// SPDX-License-Identifier: Apache-2.0
// Finds the differences between two configurations, key by key, for a message that names them.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

// Takes texts of echoed_config(): one key per line. Returns lines such as "trace.rays was 1000 and is 2000", in the
// order of the second text; a key that only one has "was not given" or "is not given". Tables in double brackets have
// an index: transmitter.0.name.
std::vector<std::string> config_changes(std::string_view was, std::string_view is);

}  // namespace wavetracer
