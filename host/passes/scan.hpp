// scan: exclusive prefix sums of block counts, in place, and their total.
// Sized for the blocks of one batch (a work-group).
#pragma once
#include "gpu/gpu.hpp"

namespace wavetracer {

class Scan {
 public:
  explicit Scan(gpu::Context& context);
  // Scans counts[0 .. count - 1] and returns their sum.
  uint32_t operator()(gpu::Buffer<uint32_t>& counts, uint32_t count);

 private:
  gpu::Kernel kernel_;
  gpu::Buffer<uint32_t> total_;
  uint32_t items_;
};

}  // namespace wavetracer
