// What a sort carries along with its keys.
// Shared by the sorts, which do not include each other.
#pragma once

namespace wavetracer {

// none: keys alone. words: a 32-bit word per key. index: like words, but the sort itself writes them: the position that
// each key had, so that values become the permutation (values[i] is where the i-th smallest key stood).
enum class Payload { none, words, index };

}  // namespace wavetracer
