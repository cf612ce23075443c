// sequences: the set of distinct sequences of all transmitters, as a trie on the device; it grows when it is full.
// A node's id is its slot, so ids change when the table grows: nothing but nodes() may hold one across regrow().
#pragma once
#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

class Sequences {
 public:
  Sequences(gpu::Context& context, uint64_t slots);
  // Empties the set and the counters.
  void clear();
  gpu::Buffer<uint64_t>& table() { return table_; }
  gpu::Buffer<wt_counters>& counters() { return counters_; }
  // Did an insertion fail since the last clear() or regrow()?
  bool overflowed() const { return counters_.read_one(0, "sequences").trie_overflow != 0; }
  // Moves every node of at most max_depth surfaces to a table four times as large. The first listed_count entries of
  // nodes() go on to name the nodes that they named.
  void regrow(uint32_t max_depth, uint32_t listed_count = 0);
  // Enters every sequence in which two neighbouring perpendicular surfaces of a known one are exchanged; grows when it
  // must. Call collect() before, whose node_count it takes, and after.
  void commute(const gpu::Buffer<wt_surface>& surfaces, uint32_t node_count, uint32_t max_depth);
  // The roots of the transmitters, then every node. Returns the length of nodes().
  uint32_t collect(uint32_t transmitter_count);
  const gpu::Buffer<uint32_t>& nodes() const { return nodes_; }

 private:
  gpu::Context& context_;
  gpu::Kernel collect_, commute_, regrow_, follow_;
  gpu::Buffer<uint64_t> table_;
  gpu::Buffer<uint32_t> nodes_;
  uint32_t roots_ = 0;  // roots at the head of nodes_
  gpu::Buffer<wt_counters> counters_;
};

}  // namespace wavetracer
