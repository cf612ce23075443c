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
  const std::string range = fmt::format("{} to {}", range_end(least), range_end(most));
  const auto refused = [=](const std::string& text) {
    Number number{};
    if (CLI::detail::lexical_cast(text, number) && !(number < least) && !(number > most)) return std::string();
    return fmt::format("{} is not a {} from {}", text, std::integral<Number> ? "whole number" : "number", range);
  };
  return CLI::Validator(refused, range);
}

// The same for a number above 0.
inline CLI::Validator positive_number() {
  const auto refused = [](const std::string& text) {
    double number = 0;
    if (CLI::detail::lexical_cast(text, number) && !(number <= 0)) return std::string();
    return fmt::format("{} is not a number above 0", text);
  };
  return CLI::Validator(refused, "above 0");
}

}  // namespace wavetracer::app
