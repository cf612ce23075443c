// SPDX-License-Identifier: Apache-2.0
// Text with one space for many, so that a test of a table need not know how wide its columns are.
#pragma once
#include <algorithm>
#include <string>

inline std::string squeezed(std::string text) {
  text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }), text.end());
  return text;
}
