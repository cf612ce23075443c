// SPDX-License-Identifier: Apache-2.0
// Ranges of numbers that options take.
#pragma once
#include <fmt/format.h>
#include <CLI/Validators.hpp>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <string>
#include "base/digits.hpp"

namespace wavetracer::app {

inline std::string range_end(double number) {
  return number >= 1000 && number == std::floor(number) ? grouped(static_cast<uint64_t>(number))
                                                        : fmt::format("{:g}", number);
}
inline std::string range_end(std::integral auto number) {
  return number < 0 ? fmt::format("{}", number) : grouped(static_cast<uint64_t>(number));
}

// Returns a check of an option whose number must be from `least` to `most`. Help has the range after the option's type.
template <class Number>
CLI::Validator number_range(Number least, Number most) {
  CLI::Validator out = CLI::Range(least, most);
  out.description(fmt::format("{} to {}", range_end(least), range_end(most)));
  return out;
}

}  // namespace wavetracer::app
