// SPDX-License-Identifier: Apache-2.0
// Kernels of the sorts, over random keys with a word each: both forms of the radix sort on every device, since a
// device's own form is the faster one only if the other is known; and the bitonic sort. bench_sort compares whole sorts
// with peers.
#pragma once
#include <span>
#include <string>

#include "kernel_rows.hpp"

namespace wavetracer::bench {

// The kernels that these rows are about.
std::span<const std::string> sort_kernels();

// n: keys of the device's own form of the radix sort; the others get fewer.
void measure_sort_kernels(KernelRows& rows, gpu::Context& context, uint32_t n);

}  // namespace wavetracer::bench
