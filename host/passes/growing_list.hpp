// Lists that kernels append to, counting: run, read the count, and where the list was too small make it larger and run
// again. Assumes that a kernel counts on beyond the capacity, and writes nothing there.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

// A counter that an earlier pass of the frame has used, and whose value has been read, begins again.
inline void zero_counter(gpu::Context& context, gpu::Buffer<wt_counters>& counters, size_t offset, const char* stage) {
  const wt_uint zero = 0;
  context.fill(counters, &zero, sizeof zero, offset, sizeof zero, stage);
}

// run(): the kernel; count(): the number that it has counted to; capacity(): of the list now; grow(n): makes room for n
// entries, and lets the counter begin again with what the list still holds. Returns the length of the list.
template <class Run, class Count, class Capacity, class Grow>
uint32_t grow_until_filled(const Run& run, const Count& count, const Capacity& capacity, const Grow& grow) {
  for (;;) {
    run();
    const uint32_t now = count();
    if (now <= capacity()) return now;
    grow(size_t{now} + now / 4);
  }
}

// The same for a list whose length is one of wt_counters, and which begins with nothing when it grows.
template <class Capacity, class Run, class Grow>
uint32_t fill_list(gpu::Buffer<wt_counters>& counters, wt_uint wt_counters::*counter, const char* stage,
                   const Capacity& capacity, const Run& run, const Grow& grow) {
  wt_counters now{};
  return grow_until_filled(
      run, [&] { return (now = counters.read_one(0, stage)).*counter; }, capacity,
      [&](size_t entries) {
        grow(entries);
        now.*counter = 0;
        counters.write(std::vector{now}, 0, stage);
      });
}

}  // namespace wavetracer
