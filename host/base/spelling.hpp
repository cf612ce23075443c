// SPDX-License-Identifier: Apache-2.0
// Hints for misspelt words: the nearest of the known ones.
// Distances are counted in bytes, which suits keys and names in ASCII.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

// Returns the number of insertions, deletions, substitutions and swaps of neighbours that turn a into b
// (optimal string alignment; F. Damerau, CACM 7(3), 1964), or `limit` if it is that or more.
size_t edit_distance(std::string_view a, std::string_view b, size_t limit = SIZE_MAX);

// Returns the known word nearest to `word`, or an empty string if none is near enough.
// A word without dots is also compared with the last part of dotted known words: `rays` finds `trace.rays`.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

// Returns `; did you mean "..."?`, or an empty string.
std::string spelling_hint(std::string_view word, const std::vector<std::string>& known);

}  // namespace wavetracer
