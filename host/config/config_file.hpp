// Config files: the public functions of wavetracer/config_file.hpp, and the text of `--help`.
// All of them are driven by the field table of fields.hpp.
#pragma once
#include <string>
#include <string_view>

#include "wavetracer/config_file.hpp"

namespace wavetracer {

// One paragraph a key. topic: a table, a key with its table or without; all keys where it is empty. Empty where there
// is nothing of this name.
std::string field_help(std::string_view topic = {});

}  // namespace wavetracer
