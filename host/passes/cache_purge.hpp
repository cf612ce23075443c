// cache_purge: removes entries that were not used since a given frame, in a pass of its own.
// Assumes that nothing else uses the table meanwhile.
#pragma once
#include "passes/cache_table.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class CachePurge {
 public:
  CachePurge(gpu::Context& context, const CacheTable& table);
  // Of every region, entries that were neither written nor touched since frame `keep_from`, and withdrawn ones. The
  // chained table cannot give up single nodes: its regions are cleared whole where more than half would go.
  void operator()(gpu::Context& context, CacheTable& table, uint32_t keep_from);

 private:
  void clear_old_regions(gpu::Context& context, CacheTable& table);

  gpu::Kernel kernel_;
  gpu::Buffer<uint32_t> old_;  // entries per region
  Work work_;
};

}  // namespace wavetracer
