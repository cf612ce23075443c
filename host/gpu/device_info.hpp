// SPDX-License-Identifier: Apache-2.0
// Properties of OpenCL devices, and the choice of one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wavetracer::gpu {

struct DeviceInfo {
  size_t index = 0;  // index in list_devices()
  std::string platform, name, driver, opencl_c, platform_version;
  bool gpu = false, cpu = false;
  uint32_t compute_units = 0;
  uint64_t global_memory = 0, max_buffer = 0, local_memory = 0;
  size_t max_work_group = 0;
  bool fp64 = false, int64_atomics = false, correctly_rounded_divide = false;
  uint32_t vector_width_float = 1;

  // Work-group size for kernels in which each item does little and works alone. GPUs start groups one by one: groups of
  // 64 limit an H200 to 105 G items/s, which is less than its memory allows.
  uint32_t simple_local_size() const { return cpu || max_work_group < 256 ? 64 : 256; }
};

// Returns all devices of all platforms, in the ICD's order. Without an ICD the list is empty.
std::vector<DeviceInfo> list_devices();
// text: empty takes the first GPU, else the first CPU; a number is an index; any other text must be part of exactly one
// device's platform or name (case-insensitive). Throws DeviceError with the list of devices and what to install.
size_t choose_device(const std::vector<DeviceInfo>& devices, std::string_view text);

// A context refuses a device that lacks these. The program needs both; some kernels, such as the sorts, need neither,
// and their tests ask for neither.
struct Needs {
  bool fp64 = true;           // double precision, for solving paths
  bool int64_atomics = true;  // for keeping sequences and caches
};

// Returns the needs that the device does not meet, with the names of the extensions; empty if it meets all.
std::string lacks(const DeviceInfo& device, const Needs& needs = {});

}  // namespace wavetracer::gpu
