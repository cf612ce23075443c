// SPDX-License-Identifier: Apache-2.0
// wedge_join: candidates of diffracted paths, from prefixes of both ends that see one wedge; with wedge_pairs also from
// those that see a wedge each. The list grows until it holds them, or as far as it may: then the caller asks for them
// in parts.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/wedge_join.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/wedge_lists.hpp"
#include "passes/wedge_pairs.hpp"

namespace wavetracer {

class WedgeJoin {
 public:
  // row_depth: interactions that a solved path has room for. wavelength_m: the longest one, for paths over free ends of
  // edges.
  WedgeJoin(gpu::Context& context, uint32_t max_depth, uint32_t row_depth, double wavelength_m = 0);
  // prefixes: sorted by their keys; first to end - 1 of them serve as those of transmitters. pairs: for paths over two
  // wedges too, or nullptr. Returns the number of candidates in list(); if it is more than most(), they are not there.
  uint32_t operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t first, uint32_t end,
                      const WedgeList& wedges, const RadioEnds& ends, Counters& counters, WedgePairs* pairs);
  // The most candidates that are listed at once: their solved paths take at most a quarter of the device's memory.
  uint32_t most() const { return most_; }
  // Does waiting for the device cost little? On CPUs it does, and there long passes run in blocks.
  bool waits() const { return context_.info().cpu; }
  void set_most(uint32_t most) { most_ = most; }
  // Throws BufferError: one prefix has this many candidates.
  [[noreturn]] void refuse(uint32_t candidates) const;
  const gpu::Buffer<wt_wedge_candidate>& list() const { return list_; }

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::wedge_join::wedge_join> kernel_;
  uint32_t max_depth_, lanes_, group_, most_;
  float end_detour_m_;
  gpu::Buffer<wt_wedge_candidate> list_;
};

}  // namespace wavetracer
