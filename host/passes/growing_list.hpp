// Lists that kernels append to, counting in wt_counters: run, read the count, and where the list was too small make it
// larger and run again. Assumes that a kernel counts on beyond the capacity, and writes nothing there.
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

// capacity(): of the list now; run(): the kernel; reserve(n): room for n entries, of which `kept` are from before, stay
// as they are and are what the counter begins with; others may be lost. Returns the length of the list.
template <class Capacity, class Run, class Reserve>
uint32_t fill_list(gpu::Buffer<wt_counters>& counters, wt_uint wt_counters::*counter, const char* stage,
                   const Capacity& capacity, const Run& run, const Reserve& reserve, uint32_t kept = 0) {
  for (;;) {
    run();
    wt_counters now = counters.read_one(0, stage);
    if (now.*counter <= capacity()) return now.*counter;
    reserve(size_t{now.*counter} + now.*counter / 4);
    now.*counter = kept;
    counters.write(std::vector{now}, 0, stage);
  }
}

}  // namespace wavetracer
