// sequences: the set of distinct sequences of all transmitters, as a trie on the device; it grows when it is full.
// A node's id is its slot, so ids change when the table grows: nothing but nodes() may hold one across regrow().
#pragma once
#include "gpu/gpu.hpp"
#include "passes/counters.hpp"
#include "passes/solved_list.hpp"
#include "passes/trie.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

class Sequences {
 public:
  // keep_ages: sequences live on from frame to frame, and their ages say which are still met.
  Sequences(gpu::Context& context, uint64_t slots, bool keep_ages = false);
  // Empties the set and the counters.
  void clear();
  // For passes that enter sequences.
  Trie trie() { return {table_, quarters_, counters_, ages(), now()}; }
  gpu::Buffer<uint64_t>& table() { return table_; }
  // Of the slots: which quarters of the launches found them, see wt_found_by in kernels/lib/trie.clh. They live as long
  // as the sequence.
  gpu::Buffer<uint32_t>& quarters() { return quarters_; }
  Counters& counters() { return counters_; }
  // Of the slots: twice the last frame, counted by begin_frame, in which a ray, an exchange or a path was there, and
  // one more if a ray was. One element if not kept.
  gpu::Buffer<uint32_t>* ages() { return keep_ages_ ? &ages_ : nullptr; }  // null: none are kept
  uint32_t frame() const { return frame_; }
  // The age of what rays meet in this frame.
  uint32_t now() const { return 2 * frame_ + 1; }
  // The next frame: what is entered from now on is younger than anything before.
  void begin_frame() { ++frame_; }
  // The visible paths' sequences get the age of this frame.
  void keep(const SolvedList& solved);
  // Drops the sequences that no ray and no path has met for `frames` frames.
  void forget(uint32_t frames, uint32_t max_depth);
  // Did an insertion fail since the last clear() or regrow()?
  bool overflowed() const { return counters_.read(Stage::sequences).trie_overflow != 0; }
  // Moves every node of at most max_depth surfaces to a table four times as large. The first listed_count entries of
  // nodes() go on to name the nodes that they named.
  void regrow(uint32_t max_depth, uint32_t listed_count = 0);
  // Enters every sequence in which two neighbouring perpendicular surfaces of a known one are exchanged; grows when it
  // must. Where ages are kept, known means met by a ray in this frame. Call collect() before, whose node_count it
  // takes. Returns the length of nodes(), which has the new ones too, or a bound of it.
  uint32_t commute(const gpu::Buffer<wt_surface>& surfaces, uint32_t node_count, uint32_t max_depth);
  // The roots of the transmitters, then every node. Returns the length of nodes(), or a bound of it.
  uint32_t collect(uint32_t transmitter_count);
  const gpu::Buffer<uint32_t>& nodes() const { return nodes_; }

 private:
  void resize(uint64_t slots);
  // At the head of nodes_, where they are not there yet.
  void write_roots(uint32_t transmitter_count);
  // A table of so many slots, or more, without the nodes older than `oldest`; where each old slot's node went.
  gpu::Buffer<uint32_t> rebuild(uint64_t slots, uint32_t max_depth, uint32_t oldest);

  gpu::Context& context_;
  bool keep_ages_;
  Work slots_work_, work_;
  gpu::Kernel clear_, collect_, commute_, regrow_, follow_, keep_;
  gpu::Buffer<uint64_t> table_;
  gpu::Buffer<uint32_t> quarters_, ages_;
  uint32_t frame_ = 1;
  gpu::Buffer<uint32_t> nodes_;
  uint32_t roots_ = 0;  // roots at the head of nodes_
  Counters counters_;
};

}  // namespace wavetracer
