// SPDX-License-Identifier: Apache-2.0
// The floors of links (link_floors) in the form in which wedge_solve takes them.
#pragma once
#include "gpu/gpu.hpp"

namespace wavetracer {

// Tables by transmitter and receiver, as kernels/lib/weak_bends.clh describes them. They must exist until the launch.
struct LinkLimits {
  const gpu::Buffer<float>& floors;
  const gpu::Buffer<uint32_t>& left_out;
  const gpu::Buffer<float>& reflectances;
  const gpu::Buffer<uint32_t>& materials_of;
  uint32_t receiver_count;
  double second;        // the factor between the floors for two edges and for one, see BendFloors
  float left_out_unit;  // units of left_out that a path at the floor has
};

}  // namespace wavetracer
