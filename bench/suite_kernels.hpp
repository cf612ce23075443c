// SPDX-License-Identifier: Apache-2.0
// Kernels that only users of the public kernel suite launch: keys of points, rays and hits that are records. Keys are
// compared with those of the host, hits with those of trace.
#pragma once
#include "kernel_rows.hpp"

namespace wavetracer::bench {

// n: points, and rays that are packed. traced: rays that are traced.
void measure_suite_kernels(KernelRows& rows, gpu::Context& context, uint32_t n, uint32_t traced);

}  // namespace wavetracer::bench
