// SPDX-License-Identifier: Apache-2.0
// wedge_pairs: candidates of paths over two wedges. Pairs that static surfaces surely hide from each other are left
// out, which loses no path (wedge_sight).
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/wedge_pairs.hpp"
#include "passes/bend_floors.hpp"
#include "passes/compact.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/scan.hpp"
#include "passes/wedge_lists.hpp"
#include "passes/wedge_sight.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

class WedgePairs {
 public:
  // scene: that of device_scene; transmission: do waves pass surfaces of it that are not opaque? Pairs whose paths are
  // surely below the floor are left out.
  WedgePairs(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, bool transmission,
             BendFloors floors = {});
  // Finds the runs of prefixes that see one wedge. The prefixes must be sorted; call this before asking for their
  // pairs.
  void list_runs(const WedgeList& wedges, const WedgePrefixList& prefixes);
  // Appends to the list, and counts in counters.wedge_candidates. join: the arguments of the same prefixes (see
  // wedge_join).
  void operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                  const RadioEnds& ends, const wt_wedge_join_arguments& join,
                  const gpu::Buffer<wt_wedge_candidate>& list, Counters& counters);

  WedgeSight sight;  // must run before prefixes are sorted

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::wedge_pairs::wedge_pairs> kernel_;
  gpu::KernelOf<calls::wedge_pairs::mark_runs> mark_;
  Work mark_work_;
  Compact compact_;
  Scan scan_;
  uint32_t lanes_, group_, kept_wedges_, run_count_ = 0;
  gpu::Buffer<uint32_t> kept_;  // a word for each static wedge with each other one: the pieces that see each other
  gpu::Buffer<float> heads_;    // numbers in the bits, as Compact takes them
  gpu::Buffer<uint32_t> runs_, blocks_;
  float floor_;
};

}  // namespace wavetracer
