// wedge_join: candidates of diffracted paths, from prefixes of both ends that see one wedge, or one wedge each.
// The list grows until it holds them.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

class WedgeJoin {
 public:
  // receiver_of_origin: of each end that launches, the receiver that it is, or WT_NONE. pairs: paths over two wedges
  // too.
  WedgeJoin(gpu::Context& context, const std::vector<uint32_t>& receiver_of_origin, uint32_t max_depth, bool pairs);
  // prefixes: sorted by their keys. Returns the number of candidates, in list().
  uint32_t operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                      const RadioEnds& ends, gpu::Buffer<wt_counters>& counters);
  const gpu::Buffer<wt_wedge_candidate>& list() const { return list_; }

 private:
  gpu::Context& context_;
  gpu::Kernel join_, pairs_;
  bool with_pairs_;
  uint32_t max_depth_, lanes_, group_;
  gpu::Buffer<uint32_t> receiver_of_origin_;
  gpu::Buffer<wt_wedge_candidate> list_;
};

}  // namespace wavetracer
