// SPDX-License-Identifier: Apache-2.0
// cache_purge: removes entries that were not used since a given frame, in a pass of its own.
// No other kernel may use the table meanwhile.
#pragma once
#include "kernel_calls/cache_purge.hpp"
#include "passes/cache_table.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class CachePurge {
 public:
  CachePurge(gpu::Context& context, const CacheTable& table);
  // Removes from every region the entries that were neither written nor touched since frame `keep_from`, and withdrawn
  // ones. The chained table cannot remove single nodes: its regions are cleared as a whole where more than half would
  // go.
  void operator()(gpu::Context& context, CacheTable& table, uint32_t keep_from);

 private:
  void clear_old_regions(gpu::Context& context, CacheTable& table);

  gpu::KernelOf<calls::cache_purge::cache_purge> kernel_;
  gpu::Buffer<uint32_t> old_;  // old entries of each region
  Work work_;
};

}  // namespace wavetracer
