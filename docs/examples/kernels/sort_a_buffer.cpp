// SPDX-License-Identifier: Apache-2.0
// Sorts a buffer of your own in your own queue: sort_a_buffer [DEVICE [KEYS]]
// DEVICE is the index of an OpenCL device, counted over all platforms (default 0); KEYS is how many (default 2^20).
#include <CL/cl.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "wavetracer/kernels/sort.hpp"

namespace {

void check(cl_int code, const char* call) {
  if (code == CL_SUCCESS) return;
  std::fprintf(stderr, "%s failed with %d\n", call, code);
  std::exit(1);
}

cl_device_id device_of(cl_uint index) {
  cl_uint platform_count = 0;
  check(clGetPlatformIDs(0, nullptr, &platform_count), "clGetPlatformIDs");
  std::vector<cl_platform_id> platforms(platform_count);
  check(clGetPlatformIDs(platform_count, platforms.data(), nullptr), "clGetPlatformIDs");
  for (const cl_platform_id platform : platforms) {
    cl_uint count = 0;
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &count) != CL_SUCCESS) continue;
    std::vector<cl_device_id> devices(count);
    check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, devices.data(), nullptr), "clGetDeviceIDs");
    if (index < count) return devices[index];
    index -= count;
  }
  std::fprintf(stderr, "there is no such device\n");
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  const cl_device_id device = device_of(argc > 1 ? static_cast<cl_uint>(std::atoi(argv[1])) : 0);
  const size_t n = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : size_t{1} << 20;

  // Everything here is the user's: context, queue, memory and events.
  cl_int code = CL_SUCCESS;
  const cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, &code);
  check(code, "clCreateContext");
  const cl_command_queue queue = clCreateCommandQueueWithProperties(context, device, nullptr, &code);
  check(code, "clCreateCommandQueueWithProperties");
  const cl_mem memory = clCreateBuffer(context, CL_MEM_READ_WRITE, n * sizeof(uint32_t), nullptr, &code);
  check(code, "clCreateBuffer");
  std::vector<uint32_t> keys(n);
  std::mt19937 random(1);
  for (uint32_t& key : keys) key = static_cast<uint32_t>(random());

  double seconds = 0;
  try {
    namespace kernels = wavetracer::kernels;
    const kernels::Context suite(context, device, queue);
    const auto buffer = suite.wrap<uint32_t>(memory);  // no copy
    kernels::Sort sort(suite, {.key_bits = 32});
    sort.reserve(n);
    for (int round = 0; round < 3; ++round) {  // the first one may compile
      cl_event written = nullptr, sorted = nullptr;
      check(clEnqueueWriteBuffer(queue, memory, CL_TRUE, 0, n * sizeof(uint32_t), keys.data(), 0, nullptr, &written),
            "clEnqueueWriteBuffer");
      const auto start = std::chrono::steady_clock::now();
      sort(buffer, n, {}, {.after = {&written, 1}, .done = &sorted});
      check(clWaitForEvents(1, &sorted), "clWaitForEvents");
      seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      clReleaseEvent(written);
      clReleaseEvent(sorted);
    }
  } catch (const wavetracer::kernels::Error& error) {
    std::fprintf(stderr, "%s (OpenCL code %d, kernel \"%s\")\n", error.what(), error.code(), error.kernel().c_str());
    return 1;
  }

  std::vector<uint32_t> sorted(n);
  check(clEnqueueReadBuffer(queue, memory, CL_TRUE, 0, n * sizeof(uint32_t), sorted.data(), 0, nullptr, nullptr),
        "clEnqueueReadBuffer");
  std::sort(keys.begin(), keys.end());
  char name[256] = "";
  check(clGetDeviceInfo(device, CL_DEVICE_NAME, sizeof name, name, nullptr), "clGetDeviceInfo");
  clReleaseMemObject(memory);
  clReleaseCommandQueue(queue);
  clReleaseContext(context);
  if (sorted != keys) {
    std::fprintf(stderr, "%s sorted %zu keys wrongly\n", name, n);
    return 1;
  }
  std::printf("%s sorted %zu keys as std::sort does, in %.3f ms\n", name, n, 1e3 * seconds);
  return 0;
}
