// SPDX-License-Identifier: Apache-2.0
// Pieces of TOML text; literal() in field_table.hpp writes whole values.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer::config {

// Returns the shortest text that reads back as x, with a point or an exponent; "inf" and "-inf".
std::string number_text(double x);

// Returns a TOML basic string: quotes, backslashes and control characters are escaped.
std::string toml_string(std::string_view text);

}  // namespace wavetracer::config
