// What this folder knows of a device beyond DeviceInfo: its OpenCL handle and the build options that follow from it.
// The order of all_devices() is that of list_devices().
#pragma once
#include <string>
#include <vector>
#include "gpu/gpu.hpp"
#include "gpu/opencl.hpp"

namespace wavetracer::gpu {

std::vector<cl::Device> all_devices();

// OpenCL C standard, memory-order back-end, WT_CPU or WT_GPU, and exact arithmetic: what every program is built with.
std::string device_options(const cl::Device& device, const DeviceInfo& info);

}  // namespace wavetracer::gpu
