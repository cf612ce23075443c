// SPDX-License-Identifier: Apache-2.0
// A check that a message has some words, which shows both if it fails.
#pragma once
#include <doctest/doctest.h>

#include <string>

#include "contains.hpp"

namespace wavetracer::test {

inline void check_contains(const std::string& text, const std::string& part) {
  CAPTURE(text);
  CAPTURE(part);
  CHECK(contains(text, part));
}

}  // namespace wavetracer::test
