// SPDX-License-Identifier: Apache-2.0
// Device data of this folder beyond DeviceInfo: the OpenCL handle and the build options. The order of all_devices() is
// that of list_devices().
#pragma once
#include <string>
#include <vector>
#include "gpu/gpu.hpp"
#include "gpu/opencl.hpp"

namespace wavetracer::gpu {

std::vector<cl::Device> all_devices();

// Returns the properties of a device. index: its place in all_devices().
DeviceInfo describe(size_t index, const cl::Device& device);

// Returns the options of every program: OpenCL C standard, memory-order back-end, WT_CPU or WT_GPU, and exact
// arithmetic.
std::string device_options(const cl::Device& device, const DeviceInfo& info);

}  // namespace wavetracer::gpu
