// SPDX-License-Identifier: Apache-2.0
// Kernels that can be measured without a scene: curves, launches, moves of rays, keys, prefix sums, compaction. The
// first 2^20 elements of each result are compared with what the host computes.
#pragma once
#include "kernel_rows.hpp"

namespace wavetracer::bench {

// n: elements of a launch.
void measure_small_kernels(KernelRows& rows, gpu::Context& context, uint32_t n);

}  // namespace wavetracer::bench
