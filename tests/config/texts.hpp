// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of config files: the shortest texts that parse, and the message that refuses a text.
#pragma once
#include <doctest/doctest.h>
#include <string>
#include <vector>
#include "check_contains.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::test {

inline const std::string scene = "scene.file = \"s.xml\"\n";  // one line
inline const std::string ends =                               // six lines
    "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n"
    "[[receiver]]\nname = \"r\"\nposition_m = [10, 0, 1.5]\n";

// The message of the ConfigError of this text, a file named a.toml, or "no error".
inline std::string error_of(const std::string& text, const std::vector<std::string>& sets = {}) {
  try {
    parse_config(text, "a.toml", sets);
  } catch (const ConfigError& e) {
    CHECK(e.code() == ExitCode::usage);
    return e.what();
  }
  return "no error";
}

}  // namespace wavetracer::test
