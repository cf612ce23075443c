// SPDX-License-Identifier: Apache-2.0
// Kernels that a user's own rays and points go through and no frame does: packed rays and hits, and keys of points.
#pragma once
#include <string>

#include "kernel_rows.hpp"

namespace wavetracer::bench {

// shared: the folder of scenes/munich; the generated city stands in for it. n: points, rays and hits that are moved.
// ray_count: rays that are traced.
void measure_packed_kernels(KernelRows& rows, gpu::Context& context, const std::string& shared, uint32_t n,
                            uint32_t ray_count);

}  // namespace wavetracer::bench
