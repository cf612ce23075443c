// SPDX-License-Identifier: Apache-2.0
// The set of sequences as kernels take it: a trie whose slots are its nodes, and the data of each slot.
// passes/sequences.hpp makes it; see also kernels/lib/trie.clh.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/counters.hpp"

namespace wavetracer {

struct Trie {
  gpu::Buffer<uint64_t>& table;
  gpu::Buffer<uint32_t>& quarters;
  Counters& counters;
  gpu::Buffer<uint32_t>* ages = nullptr;  // null where they are not kept
  uint32_t now = 0;                       // the age of sequences that rays meet in this frame
};

}  // namespace wavetracer
