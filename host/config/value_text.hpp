// Pieces of TOML text; whole values are written by literal() in field_table.hpp.
#pragma once
#include <string>
#include <string_view>

namespace wavetracer::config {

// The shortest text that reads back as x, with a point or an exponent; "inf" and "-inf".
std::string number_text(double x);

// A TOML basic string: quotes, backslashes and control characters escaped.
std::string toml_string(std::string_view text);

}  // namespace wavetracer::config
