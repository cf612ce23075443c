// SPDX-License-Identifier: Apache-2.0
// One of a few words, such as "exact" or "sphere", stored as its number: the type of configuration keys with choices. A
// word in code is checked by the compiler, and compared as a number; text at run time is converted once, by parse() or
// named().
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "wavetracer/error.hpp"

namespace wavetracer {

template <size_t N>
struct Word {
  char text[N];
  consteval Word(const char (&literal)[N]) { std::copy_n(literal, N, text); }
};

// The common base of all choices, whatever their words are.
struct ChoiceIndex {
  uint8_t value = 0;
};

template <Word... Words>
class Choice : ChoiceIndex {
 public:
  static constexpr std::array<std::string_view, sizeof...(Words)> words{Words.text...};

  constexpr Choice() = default;  // the first word
  // A literal that is not one of the words does not compile.
  consteval Choice(const char* word) : ChoiceIndex(*parse(word)) {}

  static constexpr std::optional<Choice> parse(std::string_view word) {
    const auto at = std::find(words.begin(), words.end(), word);
    if (at == words.end()) return std::nullopt;
    Choice out;
    out.value = static_cast<uint8_t>(at - words.begin());
    return out;
  }
  // Throws ConfigError, which lists the words, for any other text.
  static Choice named(std::string_view word) {
    if (const std::optional<Choice> known = parse(word)) return *known;
    std::string list;
    for (const std::string_view each : words) list += (list.empty() ? "" : ", ") + std::string(each);
    throw ConfigError("\"" + std::string(word) + "\" is none of " + list);
  }

  constexpr size_t index() const { return value; }
  constexpr std::string_view word() const { return words[value]; }
  std::string text() const { return std::string(word()); }
  ChoiceIndex& stored() { return *this; }  // for the field table, which has checked the number

  friend constexpr bool operator==(const Choice& a, const Choice& b) { return a.value == b.value; }
  template <class Stream>
  friend Stream& operator<<(Stream& stream, const Choice& choice) {
    stream << choice.word();
    return stream;
  }
};

}  // namespace wavetracer
