// The set of sequences as kernels take it: a trie whose slots are its nodes, and what is kept of each slot.
// See passes/sequences.hpp, which makes it, and kernels/lib/trie.clh.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/counters.hpp"

namespace wavetracer {

struct Trie {
  gpu::Buffer<uint64_t>& table;
  gpu::Buffer<uint32_t>& quarters;
  Counters& counters;
  gpu::Buffer<uint32_t>* ages = nullptr;  // where they are kept
  uint32_t now = 0;                       // the age of what rays meet in this frame
};

}  // namespace wavetracer
