// wedge_pairs: candidates of paths over two wedges. What static surfaces surely hide from each other is left out, and
// no path is lost by it (wedge_sight).
#pragma once
#include "gpu/gpu.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/wedge_lists.hpp"
#include "passes/wedge_sight.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

class WedgePairs {
 public:
  // The scene, of which device_scene was made, and whether waves pass surfaces of it that are not opaque.
  WedgePairs(gpu::Context& context, const DeviceScene& device_scene, const Scene& scene, bool transmission);
  // Appends to the list, and counts in counters.wedge_candidates. join: of the same prefixes (see wedge_join).
  void operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                  const RadioEnds& ends, const gpu::Buffer<uint32_t>& receiver_of_origin,
                  const wt_wedge_join_arguments& join, gpu::Buffer<wt_wedge_candidate>& list, Counters& counters);

  WedgeSight sight;  // to be asked before prefixes are sorted

 private:
  gpu::Kernel kernel_;
  uint32_t group_, kept_wedges_;
  gpu::Buffer<uint32_t> kept_;  // a word for each pair of static wedges: which pieces see each other
};

}  // namespace wavetracer
