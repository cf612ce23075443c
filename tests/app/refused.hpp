// SPDX-License-Identifier: Apache-2.0
// The answer of a program that refuses what it was asked.
#pragma once
#include <doctest/doctest.h>
#include "program.hpp"

// Checks the exit code and that the message is on stderr, and that nothing is on stdout.
inline void check(const Outcome& outcome, int code, const std::string& message) {
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  CHECK(outcome.code == code);
  CHECK(contains(outcome.err, message));
  CHECK(outcome.out.empty());
}
