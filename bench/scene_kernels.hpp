// SPDX-License-Identifier: Apache-2.0
// Kernels that need a scene and no frame: the shapes of trace, the tree over instances and their hits, all segments in
// one launch, and the growth of the set of sequences. All of them run on every device, although a frame uses only those
// that suit it.
#pragma once
#include <string>

#include "kernel_rows.hpp"

namespace wavetracer::bench {

// shared: the folder of scenes/munich; the generated city stands in for it. rays: those of a launch.
void measure_scene_kernels(KernelRows& rows, gpu::Context& context, const std::string& shared, uint32_t ray_count,
                           uint32_t vehicles);

}  // namespace wavetracer::bench
