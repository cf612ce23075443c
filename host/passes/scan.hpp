// scan: exclusive prefix sums of block counts, in place, and their total.
// One launch where few work-items suffice, else two: sums of chunks, then each chunk from the sum before it.
#pragma once
#include "gpu/gpu.hpp"

namespace wavetracer {

class Scan {
 public:
  // How a device scans: `items` work-items a chunk (a power of two), one chunk for `alone` counts or fewer, else
  // about `chunks` of them, 1024 at most.
  struct Form {
    uint32_t items, alone, chunks;
  };

  explicit Scan(gpu::Context& context);
  Scan(gpu::Context& context, Form form);
  // Scans counts[0 .. count - 1] and returns their sum, modulo 2^32.
  uint32_t operator()(gpu::Buffer<uint32_t>& counts, uint32_t count);

 private:
  Form form_;
  gpu::Kernel scan_sums_, scan_;
  gpu::Buffer<uint32_t> sums_, total_;
};

}  // namespace wavetracer
