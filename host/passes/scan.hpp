// SPDX-License-Identifier: Apache-2.0
// scan: exclusive prefix sums of block counts, in place, and their total. It is one launch where few work-items
// suffice, else two: the sums of chunks, then each chunk from the sum before it.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/scan.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class Scan {
 public:
  explicit Scan(gpu::Context& context);
  Scan(gpu::Context& context, const ScanTuning& form);
  // Scans counts[0 .. count - 1], and waits for nothing.
  void prefix(gpu::Buffer<uint32_t>& counts, uint32_t count, Stage stage = Stage::scan);
  // The same, and total[0] becomes their sum, modulo 2^32.
  void prefix(gpu::Buffer<uint32_t>& counts, uint32_t count, gpu::Buffer<uint32_t>& total, Stage stage = Stage::scan);
  // The same, and returns their sum, modulo 2^32.
  // stage: the profiling sum that the time goes to.
  uint32_t operator()(gpu::Buffer<uint32_t>& counts, uint32_t count, Stage stage = Stage::scan);

 private:
  gpu::Context& context_;
  ScanTuning form_;
  gpu::KernelOf<calls::scan::scan_sums> scan_sums_;
  gpu::KernelOf<calls::scan::scan> scan_;
  gpu::Buffer<uint32_t> sums_, total_;
};

}  // namespace wavetracer
