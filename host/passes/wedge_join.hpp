// wedge_join: candidates of diffracted paths, from prefixes of both ends that see one wedge; with wedge_pairs also from
// those that see a wedge each.
// The list grows until it holds them.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/wedge_lists.hpp"
#include "passes/wedge_pairs.hpp"

namespace wavetracer {

class WedgeJoin {
 public:
  // receiver_of_origin: of each end that launches, the receiver that it is, or WT_NONE.
  WedgeJoin(gpu::Context& context, const std::vector<uint32_t>& receiver_of_origin, uint32_t max_depth);
  // prefixes: sorted by their keys. pairs: for paths over two wedges too, or nullptr. Returns the number of candidates,
  // in list().
  uint32_t operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                      const RadioEnds& ends, Counters& counters, WedgePairs* pairs);
  const gpu::Buffer<wt_wedge_candidate>& list() const { return list_; }

 private:
  gpu::Context& context_;
  gpu::Kernel kernel_;
  uint32_t max_depth_, lanes_, group_;
  gpu::Buffer<uint32_t> receiver_of_origin_;
  gpu::Buffer<wt_wedge_candidate> list_;
};

}  // namespace wavetracer
