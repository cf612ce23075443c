// SPDX-License-Identifier: Apache-2.0
// The list of candidates of diffracted paths, which wedge_join, wedge_pairs and heard_join fill. It grows until it
// holds them, or as far as it may: then the caller asks for them in parts.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/counters.hpp"
#include "passes/growing_list.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

class WedgeCandidates {
 public:
  // row_depth: interactions that a solved path has room for.
  WedgeCandidates(gpu::Context& context, uint32_t row_depth);
  // The most candidates that are listed at once: their solved paths take at most a quarter of the device's memory.
  uint32_t most() const { return most_; }
  void set_most(uint32_t most) { most_ = most; }
  // Throws BufferError: one prefix has this many candidates.
  [[noreturn]] void refuse(uint32_t candidates) const;
  const gpu::Buffer<wt_wedge_candidate>& list() const { return list_; }
  uint32_t capacity() const { return static_cast<uint32_t>(list_.size()); }
  // run(): a pass that appends to list() and counts wt_counters::wedge_candidates. Returns their number; if it is more
  // than most(), they are not there.
  template <class Run>
  uint32_t fill(Counters& counters, Stage stage, const Run& run) {
    return fill_list(
        counters, &wt_counters::wedge_candidates, stage, [&] { return list_.size(); }, run,
        [&](size_t entries) { make_room(entries); }, 0, most_);
  }

 private:
  void make_room(size_t entries);

  gpu::Context& context_;
  uint32_t most_;
  gpu::Buffer<wt_wedge_candidate> list_;
};

}  // namespace wavetracer
