// SPDX-License-Identifier: Apache-2.0
// wedge_sight: the pieces of edges that the prefixes may see, past their last mirror and past static surfaces that
// surely hide them (kernels/lib/sight.clh). No path is lost by it; moving surfaces hide nothing here.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/wedge_sight.hpp"
#include "passes/device_scene.hpp"
#include "passes/tuning.hpp"
#include "passes/wedge_lists.hpp"
#include "wavetracer/device/arguments.h"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// The most pieces of an edge: each has a bit.
constexpr uint32_t most_pieces = 32;

class WedgeSight {
 public:
  // device_scene: made from scene. transmission: do waves pass surfaces that are not opaque? pieces: of an edge, at
  // most 32.
  WedgeSight(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, bool transmission,
             uint32_t pieces = WT_WEDGE_PIECES);
  // Tests the prefixes of the first `ends` ends, with their nodes in the trie, which are not sorted yet; those that see
  // nothing get the key WT_NONE.
  void operator()(const DeviceScene& scene, const WedgeList& wedges, const gpu::Buffer<uint64_t>& trie,
                  WedgePrefixList& prefixes, uint32_t ends = WT_NONE);
  // Returns the number of prefixes that see something. They are the first ones; the prefixes must be sorted.
  uint32_t in_sight(const WedgePrefixList& prefixes);
  uint32_t pieces() const { return pieces_; }

  // Tables for kernels that test other lines in the same way.
  const gpu::Buffer<uint32_t>& first_sides() const { return first_sides_; }
  const gpu::Buffer<double>& sides() const { return sides_; }
  wt_sight_arguments arguments(const DeviceScene& scene, uint32_t count, uint32_t kept_wedges) const;

 private:
  gpu::KernelOf<calls::wedge_sight::wedge_sight> kernel_;
  gpu::KernelOf<calls::wedge_sight::count_in_sight> count_;
  Work work_;
  bool transmission_;
  uint32_t pieces_;
  gpu::Buffer<uint32_t> first_sides_;  // see ConvexFaces
  gpu::Buffer<double> sides_;
  gpu::Buffer<uint32_t> seen_;
};

}  // namespace wavetracer
