// join: candidates of ends that send and receive, from prefixes of both that end on one surface.
// Adds to the list of candidates; the sequences are as long as both prefixes together, less the surface they share.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"

namespace wavetracer {

// The depth of prefixes that joined reach max_depth interactions.
constexpr uint32_t joined_depth(uint32_t max_depth) { return max_depth / 2 + 1; }

// Prefixes with their last surfaces as keys, to be sorted: order[i] is the place in the list of nodes that key i had.
struct PrefixList {
  gpu::Buffer<uint32_t> keys, order;
  gpu::Buffer<float> prefixes;
  uint32_t count = 0;
};

class Join {
 public:
  Join(gpu::Context& context, const std::vector<uint32_t>& receiver_of_transmitter, uint32_t max_depth);
  // The prefixes of all nodes (roots first, then trie nodes); their keys are not sorted yet, and have key_bits(scene).
  PrefixList& prefixes(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                       const gpu::Buffer<uint32_t>& nodes, uint32_t node_count);
  static unsigned key_bits(const DeviceScene& scene);
  // Appends to the candidates, of which there are candidate_count; keys are sorted. Returns how many there are then;
  // the list grows until it holds them.
  uint32_t operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint32_t>& nodes,
                      gpu::Buffer<wt_candidate>& candidates, uint32_t candidate_count,
                      gpu::Buffer<wt_counters>& counters);

 private:
  gpu::Context& context_;
  gpu::Kernel prefixes_, join_;
  uint32_t max_depth_, local_;
  gpu::Buffer<uint32_t> receiver_of_transmitter_;
  PrefixList list_;
};

}  // namespace wavetracer
