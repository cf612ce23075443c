// Config files: the public functions of wavetracer/config_file.hpp, and the text of `--help`.
// All of them are driven by the field table of fields.hpp.
#pragma once
#include "wavetracer/config_file.hpp"

namespace wavetracer {

// One paragraph a key, for `--help`.
std::string field_help();

}  // namespace wavetracer
