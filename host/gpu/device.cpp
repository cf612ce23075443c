// SPDX-License-Identifier: Apache-2.0
// Lists devices, chooses one by text, and derives build options from a device's properties. The order of platforms and
// devices does not change while the process runs (the ICD loader promises that).
#include "gpu/device.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include "gpu/pocl.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::gpu {

namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// Some drivers end their strings in zeros or blanks (CL_DEVICE_OPENCL_C_VERSION: "OpenCL C 1.2 ").
std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
  const size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first);
}

// Extension names are separated by blanks; a plain find() would also match the beginning of a longer name.
bool has_word(const std::string& words, std::string_view word) {
  return (" " + words + " ").find(fmt::format(" {} ", word)) != std::string::npos;
}

// Turns "OpenCL 3.0 PoCL ..." into 30. The specification of CL_DEVICE_VERSION fixes the form.
int opencl_version(const cl::Device& device) {
  const std::string text = device.getInfo<CL_DEVICE_VERSION>();
  return text.size() < 10 ? 10 : (text[7] - '0') * 10 + (text[9] - '0');
}

// OpenCL C 3.0 made acquire-release order and device scope optional: NVIDIA compiles CL3.0 without them, PoCL with
// them.
bool has_c11_atomics_in_cl3(const cl::Device& device) {
  if (opencl_version(device) < 30) return false;
  bool order = false, scope = false;
  for (const cl_name_version& feature : device.getInfo<CL_DEVICE_OPENCL_C_FEATURES>()) {
    order |= std::string_view(feature.name) == "__opencl_c_atomic_order_acq_rel";
    scope |= std::string_view(feature.name) == "__opencl_c_atomic_scope_device";
  }
  return order && scope;
}

// In OpenCL C 2.0 these atomics are part of the language. NVIDIA's 3.0 driver compiles it without listing it.
bool has_cl2(const cl::Device& device, const DeviceInfo& info) {
  const int version = opencl_version(device);
  return (version >= 20 && version < 30) || (version >= 30 && lower(info.platform).find("nvidia") != std::string::npos);
}

std::string device_lines(const std::vector<DeviceInfo>& devices) {
  std::string lines;
  for (const DeviceInfo& d : devices) lines += fmt::format("\n  {}: {} ({})", d.index, d.name, d.platform);
  return lines;
}

// GPUs come first, then CPUs, then other devices, each in the ICD's order.
int rank(const DeviceInfo& device) { return device.gpu ? 0 : device.cpu ? 1 : 2; }

}  // namespace

DeviceInfo describe(size_t index, const cl::Device& device) {
  const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
  const std::string extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  DeviceInfo info;
  info.index = index;
  info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  info.platform_version = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  info.opencl_c = trimmed(device.getInfo<CL_DEVICE_OPENCL_C_VERSION>());
  info.gpu = (type & CL_DEVICE_TYPE_GPU) != 0;
  info.cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
  info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.global_memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.max_buffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  info.local_memory = device.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
  info.max_work_group = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
  info.fp64 = has_word(extensions, "cl_khr_fp64");
  info.int64_atomics = has_word(extensions, "cl_khr_int64_base_atomics");
  info.correctly_rounded_divide =
      (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  info.vector_width_float = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
  return info;
}

std::vector<cl::Device> all_devices() {
  give_pocl_a_cache();
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error& error) {
    if (error.err() == CL_PLATFORM_NOT_FOUND_KHR) return {};
    throw DeviceError(fmt::format("listing the OpenCL platforms failed: {}", error_name(error.err())));
  }
  std::vector<cl::Device> all;
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
      continue;  // a platform whose hardware is absent or broken does not hide the others
    }
    all.insert(all.end(), devices.begin(), devices.end());
  }
  return all;
}

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> infos;
  for (const cl::Device& device : all_devices()) infos.push_back(describe(infos.size(), device));
  return infos;
}

size_t choose_device(const std::vector<DeviceInfo>& devices, std::string_view text) {
  if (devices.empty()) {
    if (const std::string problem = pocl_cache_problem(); !problem.empty())
      throw DeviceError("no OpenCL device was found: " + problem);
    throw DeviceError(
        "no OpenCL device on this machine. Install one: `apt install pocl-opencl-icd` runs on any CPU, "
        "and so does, "
        "without root, `pip install \"wavetracer[pocl]\"` with the command of that package; "
        "for an NVIDIA GPU whose driver came without its ICD file, put the line `libnvidia-opencl.so.1` into "
        "DIR/nvidia.icd and set OCL_ICD_VENDORS=DIR");
  }
  if (!text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); })) {
    size_t index = devices.size();
    std::from_chars(text.data(), text.data() + text.size(), index);
    if (index < devices.size()) return index;
    throw DeviceError(fmt::format("no OpenCL device has index {}; there are:{}", text, device_lines(devices)));
  }
  const std::string part = lower(text);
  const DeviceInfo* best = nullptr;
  for (const DeviceInfo& device : devices) {
    const bool matches =
        lower(device.platform).find(part) != std::string::npos || lower(device.name).find(part) != std::string::npos;
    if (matches && (!best || rank(device) < rank(*best))) best = &device;
  }
  if (!best) {
    const std::string problem = pocl_cache_problem();
    throw DeviceError(
        fmt::format("no OpenCL device or platform matches \"{}\"; give a part of a name or an index of:{}{}", text,
                    device_lines(devices), problem.empty() ? "" : "\n" + problem));
  }
  return static_cast<size_t>(best - devices.data());
}

std::string lacks(const DeviceInfo& device, const Needs& needs) {
  std::string out;
  if (needs.fp64 && !device.fp64) out = "double precision (cl_khr_fp64)";
  if (needs.int64_atomics && !device.int64_atomics)
    out += std::string(out.empty() ? "" : " and ") + "64-bit atomics (cl_khr_int64_base_atomics)";
  return out;
}

std::string device_options(const cl::Device& device, const DeviceInfo& info) {
  std::string options;
  if (has_c11_atomics_in_cl3(device)) {
    options = "-cl-std=CL3.0 -DWT_BACKEND_C11_CL3=1";
  } else if (has_cl2(device, info)) {
    options = "-cl-std=CL2.0 -DWT_BACKEND_C11_CL2=1";
  } else {
    options = "-cl-std=CL1.2 -DWT_BACKEND_LEGACY=1";
  }
  options += info.cpu ? " -DWT_CPU=1" : " -DWT_GPU=1";
  if (!info.fp64) options += " -DWT_NO_FP64=1";
  if (info.correctly_rounded_divide) options += " -cl-fp32-correctly-rounded-divide-sqrt";
  // Compilers of PoCL and NVIDIA count their warnings on stderr, which is of no use to users: "133 warnings generated."
  return options + " -w -cl-kernel-arg-info";  // launches check the size of each argument
}

}  // namespace wavetracer::gpu
