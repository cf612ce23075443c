// Host side of kernels/scan.cl.
// One work-item on CPUs: the counts of a batch fit its cache.
#include "passes/scan.hpp"

#include <algorithm>
#include <string>

namespace wavetracer {

namespace {
uint32_t items(const gpu::DeviceInfo& device) {
  return device.cpu ? 1u : static_cast<uint32_t>(std::min<size_t>(1024, device.max_work_group));
}
}  // namespace

Scan::Scan(gpu::Context& context)
    : kernel_(context.kernel("scan", "scan", {{"WT_SCAN_ITEMS", std::to_string(items(context.info())) + "u"}})),
      total_(context.buffer<uint32_t>(1, "scan total")),
      items_(items(context.info())) {}

uint32_t Scan::operator()(gpu::Buffer<uint32_t>& counts, uint32_t count) {
  kernel_({items_, items_}, "scan", counts, count, total_);
  return total_.read_one(0, "scan");
}

}  // namespace wavetracer
