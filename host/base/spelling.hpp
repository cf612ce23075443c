// Hints for misspelt words: the nearest of the known ones.
// Distances are counted in bytes, which suits keys and names in ASCII.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer {

// Insertions, deletions, substitutions and swaps of neighbours that turn a into b
// (optimal string alignment; F. Damerau, CACM 7(3), 1964); `limit` where they are that many or more.
size_t edit_distance(std::string_view a, std::string_view b, size_t limit = SIZE_MAX);

// The known word nearest to `word`, or empty where none is near enough to be what was meant.
// A word without dots is also compared with the last part of dotted known words: `rays` finds `trace.rays`.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

// `; did you mean "..."?`, or empty.
std::string spelling_hint(std::string_view word, const std::vector<std::string>& known);

}  // namespace wavetracer
