// SPDX-License-Identifier: Apache-2.0
// sequences: the set of distinct sequences of all transmitters, as a trie on the device; it grows when it is full.
// A node's id is its slot, so ids change when the table grows: only nodes() may hold one across regrow().
#pragma once
#include <functional>

#include "gpu/gpu.hpp"
#include "kernel_calls/sequences.hpp"
#include "passes/counters.hpp"
#include "passes/solved_list.hpp"
#include "passes/trie.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

class Sequences {
 public:
  // keep_ages: sequences stay from frame to frame, and their ages say which are still met.
  Sequences(gpu::Context& context, uint64_t slots, bool keep_ages = false);
  // Empties the set and the counters.
  Counters::Zeroed clear();
  // The set for passes that enter sequences.
  Trie trie() { return {table_, quarters_, counters_, ages(), now()}; }
  gpu::Buffer<uint64_t>& table() { return table_; }
  // For each slot the quarters of the launches that found it, see wt_found_by in kernels/lib/trie.clh. They last as
  // long as the sequence.
  gpu::Buffer<uint32_t>& quarters() { return quarters_; }
  Counters& counters() { return counters_; }
  // For each slot twice the last frame, counted by begin_frame, in which a ray, an exchange or a path met it, plus one
  // if a ray did. There is one element if ages are not kept.
  gpu::Buffer<uint32_t>* ages() { return keep_ages_ ? &ages_ : nullptr; }  // null: ages are not kept
  uint32_t frame() const { return frame_; }
  // The age of sequences that rays meet in this frame.
  uint32_t now() const { return 2 * frame_ + 1; }
  // Begins the next frame: sequences entered from now on are younger than all before.
  void begin_frame() { ++frame_; }
  // Gives the visible paths' sequences the age of this frame.
  void keep(const SolvedList& solved);
  // Drops the sequences that no ray and no path has met for `frames` frames.
  void forget(uint32_t frames, uint32_t max_depth);
  // Did an insertion fail since the last clear() or regrow()?
  bool overflowed() const { return counters_.read(Stage::sequences).trie_overflow != 0; }
  // Moves every node of at most max_depth surfaces to a table four times as large. The first listed_count entries of
  // nodes() still name the same nodes.
  void regrow(uint32_t max_depth, uint32_t listed_count = 0);
  // The set for kernels that enter sequences beside those that rays have found, the first node_count of `nodes`.
  struct Found {
    Trie trie;
    gpu::Buffer<uint32_t>& nodes;
    uint32_t node_count;
  };
  // Runs enter(found), which launches such kernels, and grows when it must; then that runs once more. Call collect()
  // before; it gives node_count. Returns the length of nodes(), new ones included, or a bound of it.
  uint32_t extend(uint32_t node_count, uint32_t max_depth, const std::function<void(const Found&)>& enter);
  // Enters every sequence in which two neighbouring perpendicular surfaces of a known one are exchanged. Where ages are
  // kept, known means met by a ray in this frame.
  void commute(const gpu::Buffer<wt_surface>& surfaces, const Found& found);
  // Lists the roots of the transmitters, then every node. Returns the length of nodes(), or a bound of it.
  uint32_t collect(uint32_t transmitter_count);
  const gpu::Buffer<uint32_t>& nodes() const { return nodes_; }

 private:
  void resize(uint64_t slots);
  // Writes them at the head of nodes_, where they are not there yet.
  void write_roots(uint32_t transmitter_count);
  // Makes a table of this many slots, or more, without the nodes older than `oldest`; returns the new slot of each old
  // one's node.
  gpu::Buffer<uint32_t> rebuild(uint64_t slots, uint32_t max_depth, uint32_t oldest);

  gpu::Context& context_;
  bool keep_ages_;
  Work slots_work_, work_;
  gpu::KernelOf<calls::sequences::clear> clear_;
  gpu::KernelOf<calls::sequences::collect> collect_;
  gpu::KernelOf<calls::sequences::commute> commute_;
  gpu::KernelOf<calls::sequences::regrow> regrow_;
  gpu::KernelOf<calls::sequences::follow> follow_;
  gpu::KernelOf<calls::sequences::keep> keep_;
  gpu::Buffer<uint64_t> table_;
  gpu::Buffer<uint32_t> quarters_, ages_;
  uint32_t frame_ = 1;
  gpu::Buffer<uint32_t> nodes_;
  uint32_t roots_ = 0;  // roots at the head of nodes_
  Counters counters_;
};

}  // namespace wavetracer
