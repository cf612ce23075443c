// SPDX-License-Identifier: Apache-2.0
// The data that a sort moves along with its keys. The sorts share it, since they do not include each other.
#pragma once

namespace wavetracer {

// none: only keys. words: a 32-bit word per key. index: like words, but the sort itself writes them: the position that
// each key had, so that values become the permutation (values[i] is where the i-th smallest key was).
enum class Payload { none, words, index };

}  // namespace wavetracer
