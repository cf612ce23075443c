// SPDX-License-Identifier: Apache-2.0
// Counts how often a text has a part.
#pragma once
#include <string>

inline size_t occurrences(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}
