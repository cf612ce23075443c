// SPDX-License-Identifier: Apache-2.0
// The tables of fields on the device, for passes that compute fields of their own.
#pragma once
#include "gpu/gpu.hpp"
#include "wavetracer/device/field_records.h"

namespace wavetracer {

// transmitters, receivers: the ends of the frame, once Fields::set_ends has run.
struct FieldBuffers {
  const gpu::Buffer<device::wt_material>& materials;
  const gpu::Buffer<uint32_t>& materials_of;
  const gpu::Buffer<device::wt_antenna>& antennas;
  const gpu::Buffer<double>& samples;
  const gpu::Buffer<device::wt_foliage>& foliages;
  const gpu::Buffer<device::wt_field_end>&transmitters, &receivers;
};

}  // namespace wavetracer
