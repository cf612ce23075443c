// SPDX-License-Identifier: Apache-2.0
// Reads environment variables.
#pragma once
#include <cstdlib>
#include <string>

namespace wavetracer {

// Returns the value, or an empty string where the variable is not set.
inline std::string environment(const char* variable) {
  const char* const value = std::getenv(variable);
  return value ? value : "";
}

}  // namespace wavetracer
